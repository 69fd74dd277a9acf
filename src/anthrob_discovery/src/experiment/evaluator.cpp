#include "experiment/evaluator.h"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <chrono>
#include <cstring>
#include <iterator>
#include <optional>

#include "anthrob_calib/resume/fingerprint.h"
#include "anthrob_sim/core/errors.h"
#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/model/recorded_model.h"
#include "experiment/packed_differences.h"

namespace anthrob {
namespace discovery {

namespace {

/// Sensors as the model has them, but without chance: what remains is what can be predicted.
std::shared_ptr<const RobotModel> without_noise(const std::shared_ptr<const RobotModel>& model,
                                                const Variant& variant) {
  auto quiet = std::make_shared<RobotModel>(*model);
  quiet->sensors = model->sensors.predictable();
  quiet->sensors.position.quantum = variant.position_count;
  quiet->sensors.force.quantum = variant.force_count;
  return quiet;
}

/// One of the robots in a set of recordings.
struct RecordedRobot {
  std::shared_ptr<const RobotModel> model;
  Starts starts;
};

std::uint64_t fingerprint_of(const std::vector<std::shared_ptr<const Experiment>>& experiments) {
  resume::Fingerprint all;
  for (const auto& experiment : experiments) all.add(experiment->fingerprint());
  return all.value();
}

std::uint64_t key_of(const Variant& variant, std::uint64_t recordings) {
  resume::Fingerprint key;
  key.add(variant.step).add(variant.position_count).add(variant.force_count);
  key.add(static_cast<std::uint64_t>(variant.nuisances.size()));
  for (const double value : variant.nuisances) key.add(value);
  for (const EffectInstance& effect : variant.effects) {
    key.add(effect.id).add(effect.place);
    for (const auto& [name, value] : effect.parameters) key.add(name).add(value);
  }
  return key.add(recordings).value();
}

/// Nothing where a variant was not simulated yet.
using Results = std::vector<std::optional<Differences>>;

/// For another process of this program.
std::string bytes_of(const Results& results) {
  std::string bytes;
  for (const auto& result : results) {
    const std::int64_t count = result ? result->size() : -1;
    bytes.append(reinterpret_cast<const char*>(&count), sizeof(count));
    if (count > 0) {
      bytes.append(reinterpret_cast<const char*>(result->data()),
                   static_cast<std::size_t>(count) * sizeof(float));
    }
  }
  return bytes;
}

Results results_in(const std::string& bytes) {
  Results results;
  for (std::size_t at = 0; at < bytes.size();) {
    std::int64_t count = 0;
    std::memcpy(&count, bytes.data() + at, sizeof(count));
    at += sizeof(count);
    std::optional<Differences>& result = results.emplace_back();
    if (count < 0) continue;
    const std::size_t length = static_cast<std::size_t>(count) * sizeof(float);
    result.emplace(static_cast<Eigen::Index>(count));
    std::memcpy(result->data(), bytes.data() + at, length);
    at += length;
  }
  return results;
}

}  // namespace

Evaluator::Evaluator(const std::string& model_file, std::vector<ModelParameter> nuisances,
                     double step, int jobs)
    : description_(RobotDescription::load(model_file)),
      nuisances_(std::move(nuisances)),
      step_(step),
      jobs_(jobs) {
  plain_ = build({});
}

std::vector<double> Evaluator::initial_nuisances() const {
  std::vector<double> values;
  for (const ModelParameter& p : nuisances_) values.push_back(p.initial);
  return values;
}

std::shared_ptr<const RobotModel> Evaluator::build(
    const Variant& variant, const std::map<std::string, double>& known) const {
  LoadOptions options;
  options.step = variant.step > 0.0 ? variant.step : step_;
  options.slow_controllers = options.step > step_;
  if (!variant.nuisances.empty()) options.overrides = overrides_of(nuisances_, variant.nuisances);
  for (const auto& [path, value] : known) options.overrides[path] = value;
  options.effects = variant.effects;
  return without_noise(description_.build(options), variant);
}

void Evaluator::require_buildable(const Dataset& recording) const {
  LoadOptions options;
  options.step = step_;
  build_recorded(description_, recording, options);
}

Journal& Evaluator::keep_journal(const std::string& file, std::uint64_t program) {
  resume::Fingerprint context;
  // Effect libraries may have no mark of a linker; what they hold tells.
  context.add(resume::program_fingerprint(program, effect_library_files()))
      .add(resume::model_fingerprint(description_.config()))
      .add(step_);
  for (const ModelParameter& p : nuisances_) context.add(p.path);
  journal_ = std::make_unique<Journal>(file, context.value());
  return *journal_;
}

Differences Evaluator::simulate(
    const Variant& variant,
    const std::vector<std::shared_ptr<const Experiment>>& experiments) const {
  ++simulated_;
  try {
    std::map<std::map<std::string, double>, RecordedRobot> robots;
    Differences differences = Differences::Zero(static_cast<Eigen::Index>(total_size(experiments)));
    std::vector<const RecordedRobot*> robot_of;
    std::vector<float*> out;
    std::size_t offset = 0;
    for (const auto& experiment : experiments) {
      RecordedRobot& robot = robots[experiment->known_numbers()];
      if (!robot.model) robot.model = build(variant, experiment->known_numbers());
      experiment->settle(robot.model, robot.starts);
      robot_of.push_back(&robot);
      out.push_back(differences.data() + offset);
      offset += experiment->size();
    }
    // Fits take one step after the other.
    side_by_side(experiments.size(), [&](std::size_t i) {
      experiments[i]->compare(robot_of[i]->model, robot_of[i]->starts, out[i]);
      round_differences(*experiments[i], out[i]);
    });
    differences.array() += 0.0f;  // a journal knows no -0
    if (differences.allFinite()) return differences;
  } catch (const NumericalFailure&) {
  } catch (const BadInput&) {
  }
  return {};  // no such robot
}

Differences Evaluator::known_or_simulated(
    const Variant& variant,
    const std::vector<std::shared_ptr<const Experiment>>& experiments) const {
  if (!journal_) return simulate(variant, experiments);
  const std::uint64_t recordings = fingerprint_of(experiments), key = key_of(variant, recordings);
  if (auto known = journal_->find(key, recordings)) return std::move(*known);
  Differences result = simulate(variant, experiments);
  journal_->append(key, recordings, result);
  return result;
}

std::vector<Differences> Evaluator::compare_here(
    const std::vector<Variant>& variants,
    const std::vector<std::shared_ptr<const Experiment>>& experiments) const {
  std::vector<Differences> results(variants.size());
  std::atomic<std::size_t> done{0};
  const auto begin = std::chrono::steady_clock::now();
  side_by_side(variants.size(), [&](std::size_t i) {
    results[i] = known_or_simulated(variants[i], experiments);
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
    const Batch batch{++done, variants.size(), elapsed.count()};
    const std::lock_guard<std::mutex> lock(progress_mutex_);
    if (progress_ && !progress_(batch)) throw Interrupted();
  });
  return results;
}

std::vector<Differences> Evaluator::compare_everywhere(
    const std::vector<Variant>& variants,
    const std::vector<std::shared_ptr<const Experiment>>& experiments) const {
  const std::uint64_t recordings = fingerprint_of(experiments);
  Results results(variants.size());
  if (journal_) {
    side_by_side(variants.size(), [&](std::size_t i) {
      results[i] = journal_->find(key_of(variants[i], recordings), recordings);
    });
  }
  results = results_in(session_->from_first(bytes_of(results)));
  const auto processes = static_cast<std::size_t>(session_->size());
  std::vector<std::vector<std::size_t>> shares(processes);
  std::size_t count = 0;
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (!results[i]) shares[count++ % processes].push_back(i);
  }
  const auto own = static_cast<std::size_t>(session_->rank());
  std::vector<Variant> to_do;
  for (const std::size_t i : shares[own]) to_do.push_back(variants[i]);
  std::vector<Differences> done = compare_here(to_do, experiments);
  const std::vector<std::string> all = session_->from_all(
      bytes_of({std::make_move_iterator(done.begin()), std::make_move_iterator(done.end())}));
  for (std::size_t r = 0; r < processes; ++r) {
    Results part = results_in(all[r]);
    for (std::size_t k = 0; k < part.size(); ++k) {
      const std::size_t i = shares[r][k];
      if (journal_ && r != own) {
        journal_->append(key_of(variants[i], recordings), recordings, *part[k]);
      }
      results[i] = std::move(part[k]);
    }
  }
  std::vector<Differences> complete;
  for (auto& result : results) complete.push_back(std::move(*result));
  return complete;
}

std::vector<Differences> Evaluator::compare(
    const std::vector<Variant>& variants,
    const std::vector<std::shared_ptr<const Experiment>>& experiments) const {
  return is_shared() ? compare_everywhere(variants, experiments)
                     : compare_here(variants, experiments);
}

void Evaluator::fit_side_by_side(std::size_t count,
                                 const std::function<void(std::size_t)>& work) const {
  if (!is_shared()) return side_by_side(count, work);
  for (std::size_t i = 0; i < count; ++i) work(i);
}

void Evaluator::side_by_side(std::size_t count,
                             const std::function<void(std::size_t)>& work) const {
  tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                            static_cast<std::size_t>(jobs_));
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, count, 1),
      [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) work(i);
      },
      tbb::simple_partitioner());
}

std::size_t total_size(const std::vector<std::shared_ptr<const Experiment>>& experiments) {
  std::size_t size = 0;
  for (const auto& experiment : experiments) size += experiment->size();
  return size;
}

}  // namespace discovery
}  // namespace anthrob
