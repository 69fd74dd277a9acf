#include "link/sampler.h"

#include <limits>
#include <utility>

namespace anthrob {
namespace driver {

namespace {

constexpr std::size_t kMostAnalogs = 64;

}  // namespace

Sampler::Sampler(const Hardware& hardware)
    : hardware_(hardware), joint_slopes_(hardware.joints.size()) {
  sample_.muscles.resize(hardware.muscles.size());
  finished_ = sample_;
}

void Sampler::open(const std::vector<ecu::MuscleReference>& references, double now) {
  open_ = true;
  sync_stamp_ = 0;
  sample_.time = now;
  sent_ = references;
}

void Sampler::add_analog(const EcuLink& link, int ecu, double now, Findings& findings) {
  const auto& count = link.analog().count;
  for (std::size_t j = 0; j < hardware_.joints.size(); ++j) {
    const JointSensor& joint = hardware_.joints[j];
    if (joint.ecu != ecu) continue;
    if (!LinearSensor::measures(count[joint.input])) {
      findings.add(Finding::kJointSensor, ecu, now, joint.joint);
      continue;
    }
    const double angle = joint.sensor.value(count[joint.input]);
    joint_slopes_[j].add(sample_.time, angle);
    analogs_.push_back(
        {sync_stamp_, sample_.time, AnalogSample::Kind::kJoint, j, angle, joint_slopes_[j].rate()});
  }
  for (std::size_t t = 0; t < hardware_.touch.size(); ++t) {
    const TouchSensor& touch = hardware_.touch[t];
    if (touch.ecu != ecu) continue;
    analogs_.push_back({sync_stamp_, sample_.time, AnalogSample::Kind::kTouch, t,
                        touch.sensor.force(count[touch.input]), 0.0});
  }
  // Nobody takes them: the newest are worth most.
  while (analogs_.size() > kMostAnalogs) analogs_.pop_front();
}

void Sampler::close(const std::vector<EcuLink>& links, const ecu::Supervisor& supervisor,
                    double now) {
  if (!std::exchange(open_, false)) return;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  bool anything = false;
  for (std::size_t m = 0; m < hardware_.muscles.size(); ++m) {
    const MuscleHardware& wired = hardware_.muscles[m];
    const EcuLink& link = links[static_cast<std::size_t>(wired.ecu)];
    MuscleSample& muscle = sample_.muscles[m];
    muscle = {false, nan, nan, nan, nan, nan, nan, ecu::Mode::kVoltage, ecu::State::kFault};
    muscle.mode = sent_[m].mode;
    muscle.reference = sent_[m].reference;
    if (!link.complete()) continue;
    anything = muscle.measured = true;
    const ecu::Motion& motion = link.motion(wired.channel);
    muscle.position = motion.position;
    muscle.velocity = motion.velocity;
    muscle.current = motion.current;
    muscle.voltage = link.effort().voltage[wired.channel];
    muscle.force = link.effort().force[wired.channel];
    const bool failed = supervisor.state(static_cast<int>(m)) == ecu::State::kFault;
    muscle.state = failed ? ecu::State::kFault : motion.state;
  }
  if (!anything) return;
  sample_.stamp_ns = sync_stamp_;
  sample_.round_trip = now - sample_.time;
  finished_ = sample_;
  ready_ = true;
}

bool Sampler::take(Sample& sample) {
  if (!std::exchange(ready_, false)) return false;
  sample = finished_;
  return true;
}

bool Sampler::take(AnalogSample& sample) {
  if (analogs_.empty()) return false;
  sample = analogs_.front();
  analogs_.pop_front();
  return true;
}

}  // namespace driver
}  // namespace anthrob
