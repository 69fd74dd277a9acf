#include "source/folder_source.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <utility>

#include "anthrob_core/errors.h"
#include "source/image_file.h"
#include "source/pairing.h"

namespace anthrob {
namespace mocap {

namespace fs = std::filesystem;

namespace {

using TimesByIndex = std::map<long, double>;

/// A file of a folder, and when it was taken.
struct Picture {
  long index = 0;
  std::string name;
  double t = 0.0;  ///< [s]
};
using Pictures = std::vector<Picture>;

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

TimesByIndex read_times(const std::string& file) {
  std::ifstream in(file);
  if (!in) throw BadInput(file + ": cannot be read");
  std::string line;
  TimesByIndex times;
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

std::string missing(const std::string& folder, const std::string& name) {
  return folder + ": no " + name + ", which the other folder has";
}

Image read_picture(const std::string& folder, const std::string& name) {
  const std::string file = folder + "/" + name;
  if (!fs::exists(file)) throw BadInput(missing(folder, name));
  return read_grey_image(file);
}

/// The names that either folder has.
std::vector<std::string> names_of_both(const std::string folder[2]) {
  const std::vector<std::string> left = list_images(folder[kLeft]);
  const std::vector<std::string> right = list_images(folder[kRight]);
  std::vector<std::string> names, lonely;
  std::set_union(left.begin(), left.end(), right.begin(), right.end(), std::back_inserter(names));
  std::set_symmetric_difference(left.begin(), left.end(), right.begin(), right.end(),
                                std::back_inserter(lonely));
  const double most = FolderSource::kMostFaults * static_cast<double>(names.size());
  if (static_cast<double>(lonely.size()) <= most) return names;
  const bool in_left = std::binary_search(left.begin(), left.end(), lonely.front());
  throw BadInput(missing(folder[in_left ? kRight : kLeft], lonely.front()) +
                 ": expected the same names in both, but for a tenth; " +
                 std::to_string(lonely.size()) + " of " + std::to_string(names.size()) +
                 " are in one only");
}

/// In the order of the numbers in their names, or of the names if these have no numbers.
Pictures in_order(const std::string& where, const std::vector<std::string>& names) {
  std::map<long, std::string> by_index;
  for (const std::string& name : names) {
    const std::optional<std::string> number = image_number(name);
    if (number.has_value() != image_number(names.front()).has_value()) {
      throw BadInput(where + ": " + (number ? names.front() : name) +
                     ": expected a number in the name, as other images have");
    }
    const long index =
        number ? std::strtol(number->c_str(), nullptr, 10) : static_cast<long>(by_index.size());
    const auto [other, fresh] = by_index.emplace(index, name);
    if (fresh) continue;
    throw BadInput(where + ": " + other->second + " and " + name +
                   " have the same number in their names");
  }
  Pictures pictures;
  for (const auto& [index, name] : by_index) pictures.push_back({index, name});
  return pictures;
}

void take_times(Pictures& pictures, const std::string& file) {
  const TimesByIndex times = read_times(file);
  std::optional<double> last;
  for (Picture& picture : pictures) {
    const auto t = times.find(picture.index);
    if (t == times.end()) throw BadInput(file + ": no time for " + picture.name);
    if (last && !(t->second > *last)) {
      throw BadInput(file + ": " + picture.name + ": expected times that increase");
    }
    last = picture.t = t->second;
  }
}

void take_rate(Pictures& pictures, const std::string& where, double rate) {
  for (Picture& picture : pictures) {
    picture.t = static_cast<double>(picture.index) / rate;
    if (expressible(picture.t)) continue;
    throw BadInput(where + ": " + picture.name + ": number " + std::to_string(picture.index) +
                   " at " + std::to_string(rate) +
                   " Hz gives no time from 0 to 2^32 s: expected smaller numbers, or times.csv");
  }
}

}  // namespace

FolderSource::FolderSource(const std::string& left, const std::string& right,
                           const Options& options)
    : folder_{left, right} {
  const std::optional<std::string> left_times = times_file(left), right_times = times_file(right);
  if (left_times && right_times && *left_times != *right_times) {
    pair_by_times({*left_times, *right_times}, options.sync_tolerance);
  } else {
    pair_by_names(left_times ? left_times : right_times, options.rate);
  }
}

void FolderSource::pair_by_names(const std::optional<std::string>& file, double rate) {
  const std::string both = folder_[kLeft] + ", " + folder_[kRight];
  Pictures pictures = in_order(both, names_of_both(folder_));
  if (file) {
    take_times(pictures, *file);
  } else {
    take_rate(pictures, both, rate);
    std::ostringstream text;
    text << both << ": no times.csv: taken to be " << rate << " pairs a second";
    assumption_ = text.str();
  }
  for (const Picture& picture : pictures) {
    pairs_.push_back({{picture.name, picture.name}, picture.t});
  }
}

/// Pairs the pictures like the images of a bag: in the order of time, each with the nearest.
void FolderSource::pair_by_times(const std::array<std::string, 2>& files, double tolerance) {
  std::map<double, std::string> names[2];
  std::vector<std::pair<double, Side>> order;
  for (const Side side : {kLeft, kRight}) {
    Pictures pictures = in_order(folder_[side], list_images(folder_[side]));
    take_times(pictures, files[side]);
    for (const Picture& picture : pictures) {
      names[side][picture.t] = picture.name;
      order.emplace_back(picture.t, side);
    }
  }
  std::sort(order.begin(), order.end());
  Pairing pairing(tolerance);
  for (const auto& [t, side] : order) {
    TimedImage image, pair[2];
    image.t = t;
    if (!pairing.add(side, image, pair)) continue;
    pairs_.push_back({{names[kLeft][pair[kLeft].t], names[kRight][pair[kRight].t]}, pair[kLeft].t});
  }
  pairing.end();
  judge(pairing.take_counts(), tolerance);
}

/// Refuses folders without a pair; remembers what has no partner.
void FolderSource::judge(const Pairing::Counts& counts, double tolerance) {
  const std::string both = folder_[kLeft] + ", " + folder_[kRight] + ": ";
  if (const auto why = Pairing::complaint(counts, tolerance)) throw BadInput(both + *why);
  if (counts.lost == 0) return;
  std::ostringstream text;
  text << both << counts.lost << " of " << counts.images[kLeft] + counts.images[kRight]
       << " pictures have no partner within " << 1e3 * tolerance << " ms and were left out";
  loss_ = text.str();
}

FrameSource::Grab FolderSource::next(StereoFrame& frame, double) {
  if (position_ == pairs_.size()) return Grab::kEnd;
  const Pair& pair = pairs_[position_];
  frame.index = position_++;
  frame.t = pair.t;
  frame.ns = std::llround(1e9 * frame.t);
  try {
    for (const Side side : {kLeft, kRight}) {
      frame.file[side] = folder_[side] + "/" + pair.name[side];
      auto image = std::make_shared<Image>(read_picture(folder_[side], pair.name[side]));
      frame.image[side] = image->view();
      frame.owner[side] = image;
    }
  } catch (const BadInput& error) {
    frame.leave_out(error.what());
  }
  return Grab::kFrame;
}

}  // namespace mocap
}  // namespace anthrob
