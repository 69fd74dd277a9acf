#include "sample.h"

#include <cmath>
#include <sstream>

#include "anthrob_recording/dataset.h"

namespace anthrob {

SampleMean::SampleMean(std::shared_ptr<const RobotModel> model) : model_(std::move(model)) {
  offset_ = scratch_ = Eigen::VectorXd::Zero(model_->skeleton->velocity_count);
  reset();
}

void SampleMean::reset() {
  position_.assign(model_->muscles.size(), 0.0);
  force_ = forces_ = position_;
  offset_.setZero();
  count_ = 0;
}

void SampleMean::add(const RobotMeasurement& measured) {
  if (count_ == 0) first_q_ = measured.q;
  for (std::size_t m = 0; m < position_.size(); ++m) {
    position_[m] += measured.muscles[m].position;
    if (!std::isfinite(measured.muscles[m].force)) continue;
    force_[m] += measured.muscles[m].force;
    ++forces_[m];
  }
  // Orientations are averaged in the tangent at the first one: they hardly differ.
  posture_difference(*model_->skeleton, first_q_, measured.q, scratch_);
  offset_ += scratch_;
  ++count_;
}

Sample SampleMean::mean(double time) const {
  Sample sample{time, position_, force_, first_q_};
  for (std::size_t m = 0; m < position_.size(); ++m) {
    sample.position[m] /= count_;
    sample.force[m] /= forces_[m];  // NaN without any
  }
  posture_plus(*model_->skeleton, first_q_, offset_ / count_, sample.q);
  return sample;
}

double largest_difference(const RobotModel& model, const Sample& a, const Sample& b,
                          std::string& joint) {
  double most = 0.0;
  for (const JointModel& candidate : model.skeleton->joints) {
    const double difference = joint_distance(candidate, a.q, b.q);
    if (difference < most) continue;
    most = difference;
    joint = candidate.name;
  }
  return most;
}

std::string sample_yaml(const RobotModel& model, const Sample& sample) {
  std::ostringstream out;
  const auto muscles = [&](const char* key, const std::vector<double>& values) {
    out << key << ": {";
    const char* separator = "";
    for (std::size_t m = 0; m < values.size(); ++m) {
      if (std::isnan(values[m])) continue;  // a ligament, or no force sensor: nobody measures it
      out << separator << model.muscles[m].name << ": " << exact_text(values[m]);
      separator = ", ";
    }
    out << "}, ";
  };
  out << "{time: " << exact_text(sample.time) << ", ";
  muscles("position", sample.position);
  muscles("force", sample.force);
  out << "joints: {";
  const char* separator = "";
  for (const JointModel& joint : model.skeleton->joints) {
    const double* q = &sample.q[joint.position_offset];
    out << separator << joint.name << ": ";
    if (joint.type == JointType::kBall) {
      out << "[" << exact_text(q[0]) << ", " << exact_text(q[1]) << ", " << exact_text(q[2]) << ", "
          << exact_text(q[3]) << "]";
    } else {
      out << exact_text(q[0]);
    }
    separator = ", ";
  }
  out << "}}";
  return out.str();
}

Sample read_sample(const ConfigNode& node, const RobotModel& model) {
  Sample sample;
  sample.time = node.number("time", Bounds::any(), "s");
  for (const MuscleModel& muscle : model.muscles) {
    const auto read = [&](const char* key, const char* unit, bool must) {
      const ConfigNode values = node.at(key);
      return must || values.has(muscle.name) ? values.number(muscle.name, Bounds::any(), unit)
                                             : std::nan("");
    };
    sample.position.push_back(read("position", "rad", muscle.actuator->takes_input()));
    // A muscle may have no force sensor.
    sample.force.push_back(read("force", "N", false));
  }
  sample.q = model.skeleton->rest_configuration();
  for (const JointModel& joint : model.skeleton->joints) {
    const ConfigNode value = node.at("joints").at(joint.name);
    double* q = &sample.q[joint.position_offset];
    if (joint.type != JointType::kBall) {
      q[0] = value.as_number(Bounds::any(), "rad");
      continue;
    }
    if (!value.is_sequence() || value.items().size() != 4) value.fail_expected("[w, x, y, z]");
    for (int k = 0; k < 4; ++k) q[k] = value.items()[k].as_number(Bounds::any(), "1");
  }
  return sample;
}

}  // namespace anthrob
