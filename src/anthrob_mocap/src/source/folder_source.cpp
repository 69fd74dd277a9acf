#include "source/folder_source.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "anthrob_core/errors.h"
#include "source/image_file.h"

namespace anthrob {
namespace mocap {

namespace fs = std::filesystem;

namespace {

/// Whether a stamp of ROS, which counts seconds from 0 in 32 bits, can represent the time.
bool expressible(double t) {
  return t >= 0.0 && t < 4294967296.0;
}

/// @return times.csv of a folder of images, in it or beside it; none if there is no such file
std::optional<std::string> times_file(const std::string& folder) {
  const fs::path in = fs::absolute(folder).lexically_normal();
  const fs::path parent = (in.has_filename() ? in : in.parent_path()).parent_path();
  if (fs::exists(in / "times.csv")) return folder + "/times.csv";
  if (fs::exists(parent / "times.csv")) return (parent / "times.csv").string();
  return std::nullopt;
}

std::string missing(const std::string& folder, const std::string& name) {
  return folder + ": no " + name + ", which the other folder has";
}

Image read_picture(const std::string& folder, const std::string& name) {
  const std::string file = folder + "/" + name;
  if (!fs::exists(file)) throw BadInput(missing(folder, name));
  return read_grey_image(file);
}

}  // namespace

FolderSource::FolderSource(const std::string& left, const std::string& right,
                           const Options& options)
    : folder_{left, right} {
  list_names();
  sort_names();
  load_times(options);
}

/// The names that either folder has.
void FolderSource::list_names() {
  const std::vector<std::string> left = list_images(folder_[kLeft]);
  const std::vector<std::string> right = list_images(folder_[kRight]);
  std::set_union(left.begin(), left.end(), right.begin(), right.end(), std::back_inserter(names_));
  std::vector<std::string> lonely;
  std::set_symmetric_difference(left.begin(), left.end(), right.begin(), right.end(),
                                std::back_inserter(lonely));
  const double most = kMostFaults * static_cast<double>(names_.size());
  if (static_cast<double>(lonely.size()) <= most) return;
  const bool in_left = std::binary_search(left.begin(), left.end(), lonely.front());
  throw BadInput(missing(folder_[in_left ? kRight : kLeft], lonely.front()) +
                 ": expected the same names in both, but for a tenth; " +
                 std::to_string(lonely.size()) + " of " + std::to_string(names_.size()) +
                 " are in one only");
}

void FolderSource::sort_names() {
  const std::string both = folder_[kLeft] + ", " + folder_[kRight] + ": ";
  std::map<long, std::string> by_index;
  for (const std::string& name : names_) {
    const std::optional<std::string> number = image_number(name);
    if (number.has_value() != image_number(names_.front()).has_value()) {
      throw BadInput(both + (number ? names_.front() : name) +
                     ": expected a number in the name, as other images have");
    }
    const long index =
        number ? std::strtol(number->c_str(), nullptr, 10) : static_cast<long>(by_index.size());
    const auto [other, fresh] = by_index.emplace(index, name);
    if (fresh) continue;
    throw BadInput(both + other->second + " and " + name + " have the same number in their names");
  }
  names_.clear();
  for (const auto& [index, name] : by_index) indices_.push_back(index), names_.push_back(name);
}

FolderSource::Times FolderSource::read_times(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw BadInput(file + ": cannot be read");
  std::string line;
  Times times;
  for (int number = 1; std::getline(in, line); ++number) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty() || (number == 1 && line == "index,t")) continue;
    long index = 0;
    double t = 0.0;
    char rest = 0;
    if (std::sscanf(line.c_str(), "%ld,%lf%c", &index, &t, &rest) != 2) {
      throw BadInput(file + ":" + std::to_string(number) + ": " + line + ": expected index,t");
    }
    if (!expressible(t)) {
      throw BadInput(file + ":" + std::to_string(number) + ": " + line +
                     ": expected a time >= 0 and below 2^32 [s]");
    }
    if (!times.emplace(index, t).second) {
      throw BadInput(file + ":" + std::to_string(number) + ": index " + std::to_string(index) +
                     " appears twice");
    }
  }
  if (times.empty()) throw BadInput(file + ": holds no time: expected lines index,t");
  return times;
}

void FolderSource::load_times(const Options& options) {
  Times times, right;
  std::optional<std::string> file = times_file(folder_[kLeft]);
  const std::optional<std::string> right_file = times_file(folder_[kRight]);
  if (file) times = read_times(*file);
  if (right_file && right_file != file) right = read_times(*right_file);
  if (!times.empty() && !right.empty()) {
    check_times(times, right, *right_file, options.sync_tolerance);
  }
  if (times.empty()) times.swap(right), file = right_file;
  if (times.empty()) {
    std::ostringstream text;
    text << folder_[kLeft] << ", " << folder_[kRight] << ": no times.csv: taken to be "
         << options.rate << " pairs a second";
    assumption_ = text.str();
  }
  for (std::size_t i = 0; i < names_.size(); ++i) {
    const long index = indices_[i];
    const auto t = times.find(index);
    if (!times.empty() && t == times.end()) {
      throw BadInput(*file + ": no time for " + names_[i]);
    }
    if (!right.empty() && right.count(index) == 0) {
      throw BadInput(*right_file + ": no time for " + names_[i] +
                     ", which the other times.csv has");
    }
    times_.push_back(times.empty() ? static_cast<double>(index) / options.rate : t->second);
    if (i > 0 && !(times_[i] > times_[i - 1])) {
      throw BadInput((times.empty() ? folder_[kLeft] : *file) + ": " + names_[i] +
                     ": expected times that increase");
    }
    if (!expressible(times_[i])) {
      throw BadInput(folder_[kLeft] + ": " + names_[i] + ": number " + std::to_string(index) +
                     " at " + std::to_string(options.rate) +
                     " Hz gives no time from 0 to 2^32 s: expected smaller numbers, or times.csv");
    }
  }
}

void FolderSource::check_times(const Times& left, const Times& right, const std::string& file,
                               double tolerance) {
  for (const auto& [index, t] : left) {
    const auto other = right.find(index);
    if (other != right.end() && std::abs(other->second - t) > tolerance) {
      throw BadInput(file + ": index " + std::to_string(index) +
                     ": unsynchronised pair: left and right are " +
                     std::to_string(1e3 * std::abs(other->second - t)) +
                     " ms apart, expected at most " + std::to_string(1e3 * tolerance));
    }
  }
}

FrameSource::Grab FolderSource::next(StereoFrame& frame, double) {
  if (position_ == names_.size()) return Grab::kEnd;
  frame.index = position_;
  frame.t = times_[position_];
  frame.ns = std::llround(1e9 * frame.t);
  try {
    for (const Side side : {kLeft, kRight}) {
      frame.file[side] = folder_[side] + "/" + names_[position_];
      auto image = std::make_shared<Image>(read_picture(folder_[side], names_[position_]));
      frame.image[side] = image->view();
      frame.owner[side] = image;
    }
  } catch (const BadInput& error) {
    frame.leave_out(error.what());
  }
  ++position_;
  return Grab::kFrame;
}

}  // namespace mocap
}  // namespace anthrob
