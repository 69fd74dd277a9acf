#include "scope/scope_model.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

#include "anthrob_core/text.h"

namespace anthrob {
namespace {

std::string file_name_of(const std::string& path) {
  const std::filesystem::path whole(path);
  // A folder may be given as "run/".
  return whole.has_filename() ? whole.filename().string() : whole.parent_path().filename().string();
}

bool is_of_topic(const std::string& path, const std::string& topic) {
  return path.size() > topic.size() && path.compare(0, topic.size(), topic) == 0 &&
         path[topic.size()] == '/';
}

}  // namespace

ScopeModel::ScopeModel(std::unique_ptr<LiveTopics> live, OpenRecording open)
    : live_(std::move(live)), open_(std::move(open)) {
  sources_.push_back({"live", {}, true});
}

void ScopeModel::open(const std::string& path) {
  Opened opened{open_(path), {}};
  for (const std::string& remark : opened.recording->remarks()) {
    remarks_.push_back(file_name_of(path) + ": " + remark);
  }
  opened_.push_back(std::move(opened));
  sources_.push_back({file_name_of(path), path});
  collect();
  load_ticked();
}

void ScopeModel::close(std::size_t source) {
  if (source == 0 || source >= sources_.size()) return;
  sources_.erase(sources_.begin() + static_cast<std::ptrdiff_t>(source));
  opened_.erase(opened_.begin() + static_cast<std::ptrdiff_t>(source - 1));
  collect();
}

void ScopeModel::show(std::size_t source, bool shown) {
  sources_.at(source).shown = shown;
}

void ScopeModel::shift(std::size_t source, double later) {
  sources_.at(source).later = later;
}

void ScopeModel::tick(const std::set<std::string>& paths, bool ticked) {
  for (const std::string& path : paths) {
    if (ticked) {
      ticked_.insert(path);
      continue;
    }
    ticked_.erase(path);
    windows_.erase(path);
    for (Opened& opened : opened_) opened.loaded.erase(path);
  }
  load_ticked();
  hear_needed();
}

void ScopeModel::look_into(const std::set<std::string>& topics) {
  looked_into_ = topics;
  hear_needed();
}

/// What was ticked before a topic was seen, as from a saved layout, is heard once it is there.
void ScopeModel::hear_needed() {
  std::set<std::string> needed;
  for (const std::string& topic : live_->master().topics) {
    const auto is_ours = [&](const std::string& path) { return is_of_topic(path, topic); };
    if (looked_into_.count(topic) > 0 || std::any_of(ticked_.begin(), ticked_.end(), is_ours)) {
      needed.insert(topic);
    }
  }
  live_->hear(needed);
}

void ScopeModel::load_ticked() {
  for (Opened& opened : opened_) {
    std::set<std::string> wanted;
    for (const Quantity& quantity : opened.recording->quantities()) {
      const std::string& path = quantity.path;
      if (ticked_.count(path) > 0 && opened.loaded.count(path) == 0) wanted.insert(path);
    }
    if (!wanted.empty()) opened.loaded.merge(opened.recording->load(wanted));
  }
}

void ScopeModel::collect() {
  quantities_ = live_quantities_;
  for (const Opened& opened : opened_) {
    for (const Quantity& quantity : opened.recording->quantities())
      quantities_.emplace(quantity.path, quantity);
  }
  ++version_;
}

/// New quantities of a live topic, whenever its contents change.
void ScopeModel::note(const MessageContents& contents) {
  bool changed = false;
  for (const Quantity& quantity : contents.quantities) {
    changed = live_quantities_.emplace(quantity.path, quantity).second || changed;
  }
  for (const std::string& what : contents.left_out) {
    if (left_out_.insert(what).second) remarks_.push_back("not shown: " + what);
  }
  if (changed) collect();
}

void ScopeModel::keep(const LiveMessage& message) {
  const auto& quantities = message.numbers.contents->quantities;
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    if (ticked_.count(quantities[i].path) == 0) continue;
    // Simulated time begins anew when the simulator is reset.
    live_zero_ = std::min(live_zero_.value_or(message.t), message.t);
    windows_.try_emplace(quantities[i].path, kWindow)
        .first->second.add({message.t, message.numbers.values[i]});
  }
}

bool ScopeModel::poll() {
  hear_needed();
  append(live_->take_remarks(), remarks_);
  bool kept = false;
  for (const LiveMessage& message : live_->take()) {
    auto& noted = noted_[message.topic];
    if (noted != message.numbers.contents) note(*message.numbers.contents);
    noted = message.numbers.contents;
    keep(message);
    kept = true;
  }
  return kept;
}

void ScopeModel::freeze(bool frozen) {
  if (frozen == frozen_.has_value()) return;
  if (frozen)
    frozen_ = windows_;
  else
    frozen_.reset();
}

SampleSpan ScopeModel::span_of(std::size_t source, const std::string& path) const {
  if (source == 0) {
    const Windows& windows = frozen_ ? *frozen_ : windows_;
    const auto found = windows.find(path);
    return found == windows.end() ? SampleSpan() : found->second.span();
  }
  const auto& loaded = opened_[source - 1].loaded;
  const auto found = loaded.find(path);
  return found == loaded.end() ? SampleSpan() : SampleSpan(found->second);
}

Nanoseconds ScopeModel::zero_of(std::size_t source) const {
  const Nanoseconds begin =
      source == 0 ? live_zero_.value_or(0) : opened_[source - 1].recording->begin();
  return begin - std::llround(1e9 * sources_[source].later);
}

std::vector<Curve> ScopeModel::curves() const {
  std::vector<Curve> curves;
  for (const std::string& path : ticked_) {
    const auto quantity = quantities_.find(path);
    if (quantity == quantities_.end()) continue;
    for (std::size_t source = 0; source < sources_.size(); ++source) {
      const SampleSpan samples = span_of(source, path);
      if (!sources_[source].shown || samples.empty()) continue;
      curves.push_back({quantity->second, source, samples, zero_of(source)});
    }
  }
  return curves;
}

std::vector<std::string> ScopeModel::take_remarks() {
  return std::exchange(remarks_, {});
}

std::size_t ScopeModel::live_bytes() const {
  std::size_t sum = 0;
  for (const auto& [path, window] : windows_) sum += window.bytes();
  return sum;
}

std::vector<CurvePair> pairs_of(const std::vector<Curve>& curves) {
  std::set<std::size_t> sources;
  for (const Curve& curve : curves) sources.insert(curve.source);
  std::vector<CurvePair> pairs;
  if (sources.size() < 2) return pairs;
  const std::size_t first = *sources.begin(), second = *std::next(sources.begin());
  for (std::size_t i = 0; i + 1 < curves.size(); ++i) {
    const Curve& a = curves[i];
    const Curve& b = curves[i + 1];
    if (a.quantity.path != b.quantity.path || a.source != first || b.source != second) continue;
    auto comparison = difference_between(a.samples, b.samples, a.zero - b.zero);
    if (comparison) pairs.push_back({a, b, std::move(*comparison)});
  }
  return pairs;
}

}  // namespace anthrob
