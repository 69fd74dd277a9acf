#pragma once

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "anthrob_core/random.h"
#include "anthrob_sim/effects/effect.h"
#include "experiment/excerpt.h"
#include "experiment/experiment.h"
#include "fit/model_fit.h"

namespace anthrob {
namespace discovery {

inline const std::vector<std::string> kMuscles = {"brachialis", "biceps_brachii",
                                                  "triceps_brachii"};
constexpr const char* kLaw = "force_sensor_offset";

/// Forces of three muscles that pull with nothing, as offset sensors read them.
class OffsetForces final : public Experiment {
 public:
  using Offsets = std::map<std::string, double>;
  static constexpr std::size_t kBins = 300;

  OffsetForces(Offsets truth, std::uint64_t seed) : truth_(std::move(truth)) {
    for (const std::string& muscle : kMuscles) {
      channels_.push_back({muscle, "force", "N", 0, channels_.size() * kBins, kBins, 0.0});
    }
    present_.assign(channels_.size() * kBins, 1);
    bin_ = 0.02;
    duration_ = bin_ * kBins;
    const CounterRandom random(seed, 1);
    for (std::size_t i = 0; i < present_.size(); ++i) noise_.push_back(random.normal(i));
  }

  void compare(const std::shared_ptr<const RobotModel>& model, const Starts&,
               float* out) const override {
    std::vector<ecu::Measurement> read(model->muscles.size());
    std::vector<double> positions(model->skeleton->position_count),
        velocities(model->skeleton->velocity_count);
    for (const auto& effect : model->reading_effects) {
      std::vector<double> memory(effect->state_size());
      Readings readings{read.data(), positions.data(), velocities.data()};
      effect->apply(readings, StateView(memory.data()));
    }
    for (const Channel& channel : channels_) {
      const double force = read[static_cast<std::size_t>(model->find_muscle(channel.place))].force;
      const double difference = force - truth_.at(channel.place);
      for (std::size_t b = 0; b < channel.count; ++b) {
        const std::size_t i = channel.offset + b;
        out[i] = static_cast<float>(difference + noise_[i]);
      }
    }
  }

 private:
  Offsets truth_;
  std::vector<double> noise_;
};

/// A whole recording as the excerpt of a screening.
inline Excerpt all_of(const ModelFit& fit) {
  Excerpt excerpt{fit.experiments(), {}};
  for (std::size_t i = 0; i < excerpt.experiments.front()->size(); ++i) {
    excerpt.rows.push_back(static_cast<Eigen::Index>(i));
  }
  return excerpt;
}

}  // namespace discovery
}  // namespace anthrob
