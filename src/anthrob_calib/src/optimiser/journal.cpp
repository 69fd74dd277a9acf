#include "optimiser/journal.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <sstream>

#include "anthrob_calib/resume/fingerprint.h"
#include "anthrob_core/errors.h"
#include "anthrob_core/files.h"
#include "anthrob_recording/dataset.h"

namespace anthrob {
namespace calibration {

namespace {

constexpr const char* kTitle = "anthrob_calibrate journal 3 ";
/// Without checksums. Only former builds wrote it, so its evaluations are repeated anyway.
constexpr const char* kFormerTitle = "anthrob_calibrate journal 2 ";
constexpr std::size_t kFirstEntry = 3;  ///< line, after the title and the program's

std::string program_line(std::uint64_t program) {
  std::ostringstream out;
  out << "program " << std::hex << program;
  return out.str();
}

std::uint64_t fingerprint_of(const Point& point) {
  return resume::Fingerprint().add(point.data(), point.size() * sizeof(double)).value();
}

/// @param before checksum of the line before; 0 for the first one
std::uint64_t checksum(std::uint64_t before, const std::string& text) {
  return resume::Fingerprint().add(before).add(text).value();
}

/// What a line says, without its checksum; none if the checksum is not that of the line.
std::optional<std::string> checked(const std::string& line, std::uint64_t& sum) {
  const std::size_t end = line.rfind(' ');
  if (end == std::string::npos) return std::nullopt;
  const std::string text = line.substr(0, end);
  const std::uint64_t expected = checksum(sum, text);
  if (line.substr(end + 1) != resume::fingerprint_text(expected)) return std::nullopt;
  sum = expected;
  return text;
}

}  // namespace

Journal::Journal(Evaluator& evaluator, Options options)
    : evaluator_(evaluator),
      options_(std::move(options)),
      best_fitness_(std::numeric_limits<double>::infinity()) {
  if (options_.file.empty()) return;
  const std::string folder = std::filesystem::path(options_.file).parent_path().string();
  lock_ = std::make_unique<FolderLock>(folder.empty() ? "." : folder);
  if (options_.resume) {
    load();
  } else {
    write();  // so that there is a journal to resume even before the first evaluation
  }
}

void Journal::load() {
  std::ifstream in(options_.file);
  std::string title;
  if (!in || !std::getline(in, title)) {
    throw BadInput(options_.file + ": cannot be read; expected the journal of an interrupted run");
  }
  outdated_ = title == kFormerTitle + options_.fingerprint;
  if (outdated_) return;
  if (title != kTitle + options_.fingerprint) {
    throw BadInput(options_.file +
                   ": belongs to other data, another configuration or another model; expected the "
                   "same ones, or another --out without --resume");
  }
  std::string program;
  std::getline(in, program);
  outdated_ = program != program_line(options_.program);
  if (outdated_) return;
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  read_entries(lines);
}

void Journal::read_entries(const std::vector<std::string>& lines) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string place = options_.file + ":" + std::to_string(kFirstEntry + i);
    if (const auto text = checked(lines[i], sum)) {
      char* fitness = nullptr;
      const std::uint64_t point = std::strtoull(text->c_str(), &fitness, 16);
      entries_.push_back({point, std::strtod(fitness, nullptr)});
    } else if (i + 1 == lines.size()) {
      remark_ = place + ": the last line is damaged: its evaluation is repeated";
    } else {
      throw BadInput(place +
                     ": damaged: its checksum is wrong; expected the line as it was written. Start "
                     "again with another --out, without --resume");
    }
  }
}

void Journal::check_stop() const {
  if (options_.stop && options_.stop()) throw Interrupted();
}

void Journal::note(const Point& point, double fitness) {
  ++evaluations_;
  if (fitness < best_fitness_) best_fitness_ = fitness, best_ = point;
  open_.best = open_count_ == 0 ? fitness : std::min(open_.best, fitness);
  ++open_count_;
  open_.fitness.push_back(fitness);
  if (std::isfinite(fitness)) ++open_.valid, open_sum_ += fitness;
}

Generation Journal::generation_so_far() const {
  Generation generation = open_;
  generation.evaluations = evaluations_;
  generation.best_ever = best_fitness_;
  generation.mean = generation.valid > 0 ? open_sum_ / generation.valid : HUGE_VAL;
  return generation;
}

void Journal::close_generation() {
  if (open_count_ == 0) return;
  history_.push_back(generation_so_far());
  open_ = {};
  open_sum_ = 0.0;
  open_count_ = 0;
}

std::vector<double> Journal::fitness(const std::vector<Point>& points) {
  std::vector<double> fitness;
  const std::size_t known = static_cast<std::size_t>(evaluations_);
  if (known + points.size() <= entries_.size()) {
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Entry& entry = entries_[known + i];
      if (entry.point != fingerprint_of(points[i])) {
        throw BadInput(options_.file + ": evaluation " + std::to_string(known + i + 1) +
                       " was made for other parameter values, because the program has changed; "
                       "start again with another --out, without --resume");
      }
      fitness.push_back(entry.fitness);
      ++replayed_;
    }
  } else {
    check_stop();
    // What is left of a batch that was not complete is evaluated again.
    entries_.resize(std::min(entries_.size(), known));
    fitness = evaluator_.fitness(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
      entries_.push_back({fingerprint_of(points[i]), fitness[i]});
    }
    unsaved_ += points.size();
  }
  for (std::size_t i = 0; i < points.size(); ++i) note(points[i], fitness[i]);
  if (points.size() > 1 || open_count_ >= options_.batch) close_generation();
  const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - saved_at_;
  if (unsaved_ >= static_cast<std::size_t>(options_.batch) || waited.count() >= options_.patience)
    save();
  if (options_.progress) options_.progress(evaluations_);
  return fitness;
}

std::vector<std::vector<double>> Journal::residuals(const std::vector<Point>& points) {
  check_stop();
  open_lists();
  std::vector<std::vector<double>> residuals(points.size());
  std::vector<std::size_t> unknown;
  std::vector<Point> asked;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (const auto known = lists_ ? lists_->find(fingerprint_of(points[i])) : std::nullopt) {
      residuals[i].assign(known->begin(), known->end());
      ++replayed_;
    } else {
      unknown.push_back(i);
      asked.push_back(points[i]);
    }
  }
  const auto found = evaluator_.residuals(asked);
  for (std::size_t k = 0; k < unknown.size(); ++k) {
    residuals[unknown[k]] = found[k];
    const auto size = static_cast<Eigen::Index>(found[k].size());
    if (lists_) {
      lists_->append(fingerprint_of(asked[k]),
                     Eigen::Map<const Eigen::VectorXd>(found[k].data(), size));
    }
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    double square = residuals[i].empty() ? HUGE_VAL : 0.0;
    for (const double r : residuals[i]) square += r * r;
    note(points[i], square);
  }
  if (points.size() > 1 || open_count_ >= options_.batch) close_generation();
  if (options_.progress) options_.progress(evaluations_);
  return residuals;
}

void Journal::open_lists() {
  if (lists_ || options_.file.empty()) return;
  const auto file = std::filesystem::path(options_.file).parent_path() / "residuals.bin";
  if (!options_.resume) std::filesystem::remove(file);
  if (outdated_) write();  // what is found from now on is of this build
  resume::Fingerprint context;
  context.add(options_.fingerprint).add(options_.program);
  lists_ = std::make_unique<resume::ResultFile<double>>(file.string(), context.value());
}

void Journal::save() {
  if (options_.file.empty() || unsaved_ == 0) return;
  write();
  unsaved_ = 0;
  saved_at_ = std::chrono::steady_clock::now();
}

void Journal::write() const {
  std::ostringstream out;
  out << kTitle << options_.fingerprint << "\n" << program_line(options_.program) << "\n";
  std::uint64_t sum = 0;
  for (const Entry& entry : entries_) {
    const std::string text = resume::fingerprint_text(entry.point) + " " +
                             (std::isfinite(entry.fitness) ? exact_text(entry.fitness) : "inf");
    sum = checksum(sum, text);
    out << text << " " << resume::fingerprint_text(sum) << "\n";
  }
  write_file_atomically(options_.file, out.str());
}

std::vector<Generation> Journal::history() const {
  std::vector<Generation> history = history_;
  if (open_count_ > 0) history.push_back(generation_so_far());
  return history;
}

}  // namespace calibration
}  // namespace anthrob
