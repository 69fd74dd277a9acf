#include "hypotheses/axis_doses.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

namespace anthrob {
namespace discovery {

namespace {

/// How a driven joint was used.
struct Use {
  double effort = 0.0;  ///< that the given model lacks, rms [Nm, N]
  double all = 0.0;     ///< that was recorded, rms [Nm, N]
  double range = 0.0;   ///< of positions, half [rad, m]
  double speed = 0.0;   ///< way over time, while it was not at rest [rad/s, m/s]
};

double rms(const std::vector<Dataset>& recordings, const std::string& column) {
  double squares = 0.0, count = 0.0;
  for (const Dataset& recording : recordings) {
    for (const double value : recording.series(column).values) {
      squares += value * value;
      count += 1.0;
    }
  }
  return count > 0.0 ? std::sqrt(squares / count) : 0.0;
}

Use use_of(const std::string& joint, const std::vector<Dataset>& recordings) {
  double low = HUGE_VAL, high = -HUGE_VAL, way = 0.0, time = 0.0;
  for (const Dataset& recording : recordings) {
    const Series position = recording.series(joint + "/position");
    for (std::size_t i = 0; i < position.values.size(); ++i) {
      low = std::min(low, position.values[i]);
      high = std::max(high, position.values[i]);
      if (i == 0 || position.values[i] == position.values[i - 1]) continue;
      way += std::abs(position.values[i] - position.values[i - 1]);
      time += position.t[i] - position.t[i - 1];
    }
  }
  Use use;
  use.all = rms(recordings, joint + "/effort");
  if (high > low) use.range = 0.5 * (high - low);
  if (time > 0.0) use.speed = way / time;
  return use;
}

/// What the given model lacks at a joint, root mean square over the bins [Nm, N].
double lacking(const std::string& joint, const Experiments& experiments,
               const Differences& differences) {
  double squares = 0.0, count = 0.0;
  std::size_t offset = 0;
  for (const auto& experiment : experiments) {
    for (const Channel& channel : experiment->channels()) {
      if (channel.place != joint) continue;
      for (std::size_t b = channel.offset; b < channel.offset + channel.count; ++b) {
        if (!experiment->present()[b]) continue;
        const double value = differences[static_cast<Eigen::Index>(offset + b)];
        squares += value * value;
        count += 1.0;
      }
    }
    offset += experiment->size();
  }
  return count > 0.0 ? std::sqrt(squares / count) : 0.0;
}

/// A natural size of a quantity of that unit; 0: there is none.
double natural(const std::string& unit, const Use& use) {
  if (unit == "Nm" || unit == "N") return use.effort;
  if ((unit == "Nms/rad" || unit == "Ns/m") && use.speed > 0.0) return use.effort / use.speed;
  if ((unit == "Nms2/rad2" || unit == "Ns2/m2") && use.speed > 0.0) {
    return use.effort / (use.speed * use.speed);
  }
  if ((unit == "Nm/rad" || unit == "N/m") && use.range > 0.0) return use.effort / use.range;
  return 0.0;
}

/// [kg]; 0 if there is no such body.
double mass_of(const std::string& body, const SkeletonModel& skeleton) {
  for (const BodyModel& b : skeleton.bodies) {
    if (b.name == body) return b.mass;
  }
  return 0.0;
}

}  // namespace

void scale_doses(const Evaluator& evaluator, const Admission& admission,
                 const AxisDoseOptions& options, std::vector<Candidate>& candidates) {
  const RobotModel& model = *evaluator.model();
  if (!model.muscles.empty()) return;
  const Differences given = evaluator.compare({Variant{}}, admission.train).front();
  if (given.size() == 0) return;  // told with the floors
  std::map<std::string, Use> uses;
  for (const JointModel& joint : model.skeleton->joints) {
    if (!joint.driven) continue;
    uses[joint.name] = use_of(joint.name, admission.question.train);
    uses[joint.name].effort = lacking(joint.name, admission.train, given);
  }
  for (Candidate& candidate : candidates) {
    const auto use = uses.find(candidate.place);
    const double mass = mass_of(candidate.place, *model.skeleton);
    for (EffectParameter& p : candidate.parameters) {
      const double size = p.unit == "kg"      ? options.share_of_mass.value * mass
                          : use == uses.end() ? 0.0
                                              : options.share.value * natural(p.unit, use->second);
      if (p.kind != EffectParameter::kSize || !(size > 0.0)) continue;
      const bool up = p.typical >= p.neutral;
      const double room = 0.5 * (up ? p.bounds.hi - p.neutral : p.neutral - p.bounds.lo);
      p.typical = p.neutral + std::copysign(std::min(size, room), up ? 1.0 : -1.0);
      if (use == uses.end() || !(use->second.effort > 0.0)) continue;
      // A law may well take as much as the drive gives.
      candidate.realistic_doses = use->second.all / (options.share.value * use->second.effort);
    }
  }
}

}  // namespace discovery
}  // namespace anthrob
