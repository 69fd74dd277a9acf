#include "hypotheses/periods_from_data.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "anthrob_sim/skeleton/skeleton_model.h"
#include "hypotheses/periods.h"

namespace anthrob {
namespace discovery {

namespace {

std::string term(const char* name, std::size_t k) {
  return std::string(name) + "_" + std::to_string(k);
}

EffectParameter* parameter_of(Candidate& candidate, const std::string& name) {
  for (EffectParameter& p : candidate.parameters) {
    if (p.name == name) return &p;
  }
  return nullptr;
}

/// How many terms the series of a candidate has; 0: it is none.
std::size_t terms_of(Candidate& candidate) {
  std::size_t k = 0;
  while (parameter_of(candidate, term("periods", k + 1)) &&
         parameter_of(candidate, term("sine", k + 1)) &&
         parameter_of(candidate, term("cosine", k + 1))) {
    ++k;
  }
  return k;
}

const MeasuredVariable* variable_of(const std::vector<MeasuredVariable>& variables,
                                    const std::string& name, const std::string& word) {
  for (const MeasuredVariable& v : variables) {
    if (v.name == name && v.word == word) return &v;
  }
  return nullptr;
}

/// @param per_unit turns a radian, or metres a metre   @return nothing if it is not compared
std::optional<EffortAlongWay> missing_effort(const Experiments& train,
                                             const std::vector<MeasuredVariable>& variables,
                                             const Differences& differences,
                                             const std::string& joint, double per_unit) {
  const MeasuredVariable* position = variable_of(variables, joint + "/position", "posture");
  const MeasuredVariable* speed = variable_of(variables, joint + "/position", "speed");
  if (!position || !speed) return std::nullopt;
  EffortAlongWay data;
  std::size_t begin = 0;
  for (std::size_t e = 0; e < train.size(); ++e) {
    const Experiment& experiment = *train[e];
    data.runs.push_back(data.position.size());
    for (const Channel& channel : experiment.channels()) {
      if (channel.place != joint || channel.quantity != "effort") continue;
      for (std::size_t b = 0; b < channel.count; ++b) {
        if (!experiment.present()[channel.offset + b]) continue;
        data.position.push_back(per_unit * position->values[e][b]);
        data.velocity.push_back(per_unit * speed->values[e][b]);
        data.effort.push_back(-differences[static_cast<Eigen::Index>(begin + channel.offset + b)]);
      }
    }
    begin += experiment.size();
  }
  if (data.effort.empty()) return std::nullopt;
  return data;
}

void set_term(Candidate& candidate, std::size_t k, const Period& period) {
  EffectParameter& number = *parameter_of(candidate, term("periods", k));
  number.neutral = number.typical = std::min(period.number, number.bounds.hi);
  const double amplitude = std::hypot(period.sine, period.cosine);
  for (const char* part : {"sine", "cosine"}) {
    EffectParameter& size = *parameter_of(candidate, term(part, k));
    size.typical = std::min(amplitude, size.bounds.hi);
  }
}

void drop_term(Candidate& candidate, std::size_t k) {
  for (const char* part : {"periods", "sine", "cosine"}) {
    const std::string name = term(part, k);
    candidate.parameters.erase(
        std::remove_if(candidate.parameters.begin(), candidate.parameters.end(),
                       [&](const EffectParameter& p) { return p.name == name; }),
        candidate.parameters.end());
  }
}

}  // namespace

std::vector<std::string> take_periods_from_data(const Evaluator& evaluator,
                                                const Experiments& train,
                                                const std::vector<MeasuredVariable>& variables,
                                                const PeriodOptions& options,
                                                std::vector<Candidate>& candidates) {
  std::vector<std::string> taken_out;
  std::vector<Candidate> kept;
  Differences differences;
  for (Candidate& candidate : candidates) {
    const std::size_t terms = terms_of(candidate);
    if (terms == 0) {
      kept.push_back(std::move(candidate));
      continue;
    }
    const SkeletonModel& skeleton = *evaluator.model()->skeleton;
    const int joint = skeleton.find_joint(candidate.place);
    const bool turns = joint >= 0 && skeleton.joints[static_cast<std::size_t>(joint)].type !=
                                         JointType::kPrismatic;
    std::vector<Period> periods;
    const auto channels = channels_of(train);
    const bool compared = std::any_of(channels.begin(), channels.end(), [&](const Channel& c) {
      return c.place == candidate.place && c.quantity == "effort";
    });
    if (compared && differences.size() == 0) {
      differences = evaluator.compare({Variant{}}, train).front();
    }
    if (compared && differences.size() > 0) {
      const auto data =
          missing_effort(train, variables, differences, candidate.place, turns ? 0.5 / M_PI : 1.0);
      if (data) periods = find_periods(*data, terms, turns, options);
    }
    if (periods.empty()) {
      taken_out.push_back(candidate.name());
      continue;
    }
    for (std::size_t k = 1; k <= terms; ++k) {
      if (k <= periods.size()) {
        set_term(candidate, k, periods[k - 1]);
      } else {
        drop_term(candidate, k);
      }
    }
    kept.push_back(std::move(candidate));
  }
  candidates = std::move(kept);
  return taken_out;
}

}  // namespace discovery
}  // namespace anthrob
