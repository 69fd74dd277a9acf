#include "recording_store.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <map>
#include <sstream>

#include "anthrob_core/files.h"

namespace anthrob {

namespace fs = std::filesystem;

namespace {

constexpr const char* kPart = ".part";

/// NAME.bag.part, and NAME.yaml.part1234 while that is written.
bool is_part(const fs::path& file) {
  const std::string extension = file.extension().string();
  return extension.rfind(kPart, 0) == 0 &&
         extension.find_first_not_of("0123456789", std::strlen(kPart)) == std::string::npos;
}

/// FNV-1a: enough to tell two protocols or models apart.
std::string fingerprint(const std::string& text) {
  std::uint64_t hash = 14695981039346656037ULL;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ULL;
  char digits[20];
  std::snprintf(digits, sizeof(digits), "%016llx", static_cast<unsigned long long>(hash));
  return digits;
}

/// "model_robot.yaml 0123456789abcdef"; none without a file.
std::optional<std::string> identity_of(const std::string& model_file) {
  if (model_file.empty()) return std::nullopt;
  const std::string text = ConfigNode::load(model_file).to_yaml();
  return fs::path(model_file).filename().string() + " " + fingerprint(text);
}

}  // namespace

RecordingStore::RecordingStore(const std::string& folder, std::shared_ptr<const RobotModel> model,
                               const Protocol& protocol, const std::string& time,
                               const std::string& simulated)
    : folder_(folder),
      model_(std::move(model)),
      protocol_(protocol),
      time_(time),
      simulated_(identity_of(simulated)) {
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) throw std::runtime_error(folder_ + ": cannot be created: " + error.message());
  lock_.emplace(folder_);  // before parts are deleted: they may still grow
  const auto remove_parts = [&](const std::string& of) {
    for (const auto& entry : fs::directory_iterator(folder_)) {
      const bool wanted = of.empty() || entry.path().stem() == of;
      if (wanted && is_part(entry.path())) fs::remove(entry.path());
    }
  };
  const std::string session = file("session.yaml");
  if (!fs::exists(session)) {
    remove_parts("session.yaml");  // killed while it was written
    if (!fs::is_empty(folder_))
      throw BadInput(folder_ + ": has files but no session.yaml; expected a new or empty folder");
    write_file_atomically(session, session_text());
    return;
  }
  const ConfigNode node = ConfigNode::load(session);
  if (node.text("fingerprint") != "f" + fingerprint(protocol_.text) ||
      node.text("model") != fs::path(model_->file).filename().string()) {
    throw BadInput(session + ": belongs to another protocol, other postures or another model; " +
                   "expected a new folder, or those with which it began");
  }
  const auto expect = [&](const char* key, const std::string& now) {
    if (node.has(key) && node.text(key) != now) {
      node.at(key).fail_expected(now +
                                 ", or a new folder: a session has one robot, simulated by one "
                                 "model or in true time");
    }
  };
  expect("robot", model_->name);
  expect("time", time_);
  if (simulated_) expect("simulated", *simulated_);
  if (node.has("rest")) baseline_ = read_sample(node.at("rest"), *model_);
  remove_parts("");
}

std::string RecordingStore::session_text() const {
  std::ostringstream out;
  out << "# Session of anthrob_recorder. After an interruption, the same command continues it.\n"
      << "protocol: " << word(protocol_.kind) << "\nrobot: " << model_->name << "\ntime: " << time_
      << "\nmodel: " << fs::path(model_->file).filename().string() << "\nfingerprint: f"
      << fingerprint(protocol_.text) << "  # of protocol, postures and references\n";
  if (simulated_) out << "simulated: " << *simulated_ << "  # by this model\n";
  if (baseline()) {
    out << "rest: " << sample_yaml(*model_, baseline_)
        << "  # the first rest posture; drift is measured from it\n";
  }
  return out.str();
}

void RecordingStore::set_baseline(const Sample& rest) {
  baseline_ = rest;
  write_file_atomically(file("session.yaml"), session_text());
}

std::vector<std::string> RecordingStore::names(const Protocol::Target& target, int repeat) const {
  const std::string run = "_run" + std::to_string(repeat);
  if (protocol_.kind != Protocol::Kind::kTrajectories) return {target.name + run};
  return {protocol_.rest.name + "_to_" + target.name + run,
          target.name + "_to_" + protocol_.rest.name + run};
}

bool RecordingStore::complete(const std::string& name) const {
  return fs::exists(file(name + ".bag")) && fs::exists(file(name + ".yaml"));
}

std::string RecordingStore::partial_bag(const std::string& name) const {
  return file(name + ".bag" + kPart);
}

void RecordingStore::discard(const std::string& name) const {
  std::error_code ignored;
  fs::remove(partial_bag(name), ignored);
}

void RecordingStore::finish(const std::string& name, DatasetMeta meta, const Sample& sample) {
  meta.robot = model_->name;
  meta.other["sample"] = sample_yaml(*model_, sample) + "\n";
  keep_on_disk(partial_bag(name));
  // A description that an earlier run left must not describe this bag.
  fs::remove(file(name + ".yaml"));
  fs::rename(partial_bag(name), file(name + ".bag"));
  write_file_atomically(file(name + ".yaml"), meta_text(meta));
  samples_.erase(name);  // of an earlier run of that name
}

const Sample& RecordingStore::sample_of(const std::string& name) {
  const auto known = samples_.find(name);
  if (known != samples_.end()) return known->second;
  const ConfigNode node = ConfigNode::load(file(name + ".yaml"));
  return samples_[name] = read_sample(node.at("sample"), *model_);
}

std::vector<RecordingStore::Entry> RecordingStore::entries() {
  std::vector<Entry> list;
  for (int repeat = 1; repeat <= protocol_.repeats; ++repeat) {
    for (const Protocol::Target& target : protocol_.targets) {
      const auto recorded = names(target, repeat);
      for (std::size_t i = 0; i < recorded.size(); ++i) {
        if (!complete(recorded[i])) continue;
        const std::string to = i == 0 ? target.name : protocol_.rest.name + " from " + target.name;
        list.push_back({recorded[i], to, sample_of(recorded[i])});
      }
    }
  }
  return list;
}

void RecordingStore::summarise() {
  const std::vector<Entry> all = entries();
  write_samples(all);
  write_repeatability(all);
}

void RecordingStore::write_samples(const std::vector<Entry>& all) const {
  std::ostringstream out;
  out << "recording,posture";
  for (const char* quantity : {"position", "force"}) {
    for (const MuscleModel& muscle : model_->muscles) out << "," << muscle.name << "/" << quantity;
  }
  for (const JointModel& joint : model_->skeleton->joints) {
    if (joint.type == JointType::kBall) {
      for (const char* axis : {"w", "x", "y", "z"}) out << "," << joint.name << "/" << axis;
    } else {
      out << "," << joint.name << "/position";
    }
  }
  out << "\n";
  for (const Entry& entry : all) {
    out << entry.name << "," << entry.target;
    for (const auto* values : {&entry.sample.position, &entry.sample.force, &entry.sample.q}) {
      for (const double value : *values) {
        out << ",";
        if (!std::isnan(value)) out << exact_text(value);
      }
    }
    out << "\n";
  }
  write_file_atomically(file("samples.csv"), out.str());
}

void RecordingStore::write_repeatability(const std::vector<Entry>& all) const {
  std::map<std::string, std::vector<const Entry*>> by_target;
  for (const Entry& entry : all) by_target[entry.target].push_back(&entry);
  std::ostringstream out;
  out << "posture,joint,pairs,mean_rad,max_rad\n";
  for (const auto& [target, runs] : by_target) {
    for (const JointModel& joint : model_->skeleton->joints) {
      double sum = 0.0, most = 0.0;
      int pairs = 0;
      for (std::size_t i = 0; i < runs.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k, ++pairs) {
          const double apart = joint_distance(joint, runs[i]->sample.q, runs[k]->sample.q);
          sum += apart, most = std::max(most, apart);
        }
      }
      if (pairs == 0) continue;
      out << target << "," << joint.name << "," << pairs << "," << exact_text(sum / pairs) << ","
          << exact_text(most) << "\n";
    }
  }
  if (protocol_.repeats > 1) write_file_atomically(file("repeatability.csv"), out.str());
}

}  // namespace anthrob
