#include "identification/ring_identification.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>

#include "anthrob_core/errors.h"

namespace anthrob {
namespace identification {

namespace {

auto order(const RingRecording& r) {
  return std::make_tuple(r.specimen.ring, r.specimen.number, r.run);
}

/// Strains above the ellipse only.
std::optional<double> mean_used(const std::map<double, double>& errors) {
  double sum = 0.0;
  int count = 0;
  for (const auto& [strain, error] : errors) {
    if (strain <= kEllipseStrain) continue;
    sum += error;
    ++count;
  }
  return count > 0 ? std::optional<double>(sum / count) : std::nullopt;
}

/// Adds errors of a recording; strains of several specimens stand beside each other.
void add_errors(const ViscoelasticFit& fit, double zero, const RingRecording& recording,
                std::map<double, double>& errors) {
  for (const RelaxationTest& test : recording.tests) {
    errors[test.strain] = hold_error(fit.model(), zero, recording, test);
  }
}

bool last_run_of_specimen(const std::vector<RingRecording>& sorted, std::size_t i) {
  return i + 1 == sorted.size() || sorted[i + 1].specimen.number != sorted[i].specimen.number;
}

RingModelResult fit_model(const RingResult& ring, std::size_t arms) {
  RingModelResult result;
  result.arms = arms;
  const RingRecording& fitted = ring.recordings[ring.fitted];
  try {
    result.fit = fit_viscoelastic(fitted, arms);
  } catch (const BadInput&) {
    throw;
  } catch (const std::runtime_error& error) {
    result.failure = error.what();
    return result;
  }
  add_errors(*result.fit, result.fit->zero_or_none(), fitted, result.fit_error);
  for (std::size_t i = ring.fitted + 1; i < ring.recordings.size(); ++i) {
    if (!last_run_of_specimen(ring.recordings, i)) continue;
    add_errors(*result.fit, 0.0, ring.recordings[i], result.validation_error);
  }
  return result;
}

}  // namespace

std::optional<double> RingModelResult::mean_fit_error() const {
  return mean_used(fit_error);
}
std::optional<double> RingModelResult::mean_validation_error() const {
  return mean_used(validation_error);
}

bool RingResult::has_fit() const {
  return std::any_of(models.begin(), models.end(),
                     [](const RingModelResult& model) { return model.fit.has_value(); });
}

const RingModelResult* RingResult::better() const {
  const RingModelResult* best = nullptr;
  for (const RingModelResult& model : models) {
    if (!model.fit) continue;
    if (!best) {
      best = &model;
      continue;
    }
    const auto error = [](const RingModelResult& of) {
      return of.mean_validation_error().value_or(of.mean_fit_error().value_or(HUGE_VAL));
    };
    if (model.fit->shows_its_arms() && error(model) < error(*best)) best = &model;
  }
  return best;
}

std::vector<RingResult> identify_rings(std::vector<RingRecording> recordings) {
  std::sort(recordings.begin(), recordings.end(),
            [](const auto& a, const auto& b) { return order(a) < order(b); });
  for (std::size_t i = 1; i < recordings.size(); ++i) {
    if (order(recordings[i]) == order(recordings[i - 1])) {
      throw BadInput(recordings[i].name + ": the same ring, specimen and run as " +
                     recordings[i - 1].name + "; expected each recording once");
    }
  }
  std::vector<RingResult> results;
  for (RingRecording& recording : recordings) {
    if (results.empty() || results.back().ring != recording.specimen.ring) {
      results.push_back({recording.specimen.ring, {}, 0, {}});
    }
    results.back().recordings.push_back(std::move(recording));
  }
  for (RingResult& ring : results) {
    while (!last_run_of_specimen(ring.recordings, ring.fitted)) ++ring.fitted;
    for (const std::size_t arms : {std::size_t{1}, std::size_t{2}}) {
      ring.models.push_back(fit_model(ring, arms));
    }
  }
  return results;
}

}  // namespace identification
}  // namespace anthrob
