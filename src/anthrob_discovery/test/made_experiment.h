#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "anthrob_core/random.h"
#include "experiment/experiment.h"

namespace anthrob {
namespace discovery {

/// Differences made from the damping of the model's joints [Nms/rad] and the dry friction of its
/// elbow [Nm], so that slopes and ends are known, and maybe otherwise with a coarse step; and noise
/// of one unit where there are several.
class MadeExperiment final : public Experiment {
 public:
  using Law = std::function<double(double elbow, double shoulder, double dry)>;
  using OfModel = std::function<double(const RobotModel&)>;
  static constexpr double kStep = 0.001, kCoarse = 0.002;  // [s]

  MadeExperiment(const Law& difference, const Law& coarse, std::size_t bins = 1,
                 std::uint64_t seed = 0)
      : MadeExperiment(of_model(difference), of_model(coarse), bins, seed) {}
  /// The same, made from whatever is in the model.
  MadeExperiment(OfModel difference, OfModel coarse, std::size_t bins, std::uint64_t seed)
      : difference_(std::move(difference)), coarse_(std::move(coarse)) {
    channels_ = {{"elbow", "position", "rad", 0, 0, bins, 0.0}};
    present_.assign(bins, 1);
    bin_ = 0.02;
    duration_ = bin_ * static_cast<double>(bins);
    const CounterRandom random(seed, 1);
    for (std::size_t b = 0; b < bins; ++b) noise_.push_back(bins > 1 ? random.normal(b) : 0.0);
  }

  /// As of a file with few digits.
  void set_step_of_digits(double step) { channels_.front().digits = step; }

  void compare(const std::shared_ptr<const RobotModel>& model, const Starts&,
               float* out) const override {
    const double difference = (model->step == kCoarse ? coarse_ : difference_)(*model);
    for (std::size_t b = 0; b < noise_.size(); ++b) {
      out[b] = static_cast<float>(difference + noise_[b]);
    }
  }

  static JointFrictionModel friction_of(const RobotModel& model, const std::string& joint) {
    const auto index = static_cast<std::size_t>(model.skeleton->find_joint(joint));
    return model.skeleton->joints[index].friction;
  }

 private:
  static OfModel of_model(const Law& law) {
    return [law](const RobotModel& model) {
      const JointFrictionModel elbow = friction_of(model, "elbow");
      return law(elbow.viscous, friction_of(model, "shoulder").viscous, elbow.kinetic_torque);
    };
  }

  OfModel difference_, coarse_;
  std::vector<double> noise_;
};

}  // namespace discovery
}  // namespace anthrob
