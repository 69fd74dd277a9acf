#include "experiment/chain_experiment.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "anthrob_calib/resume/fingerprint.h"
#include "anthrob_recording/resolution.h"
#include "experiment/cut_off_noise.h"
#include "experiment/noise_floor.h"
#include "experiment/packed_differences.h"

namespace anthrob {
namespace discovery {

namespace {

/// A time between two steps.
struct Moment {
  std::int64_t step;  ///< that arrives at or after it
  double share;       ///< of that step in the state at this time
};

Moment moment(double time, double step) {
  const double steps = time / step;
  const auto next = static_cast<std::int64_t>(std::ceil(steps - 1e-6));
  const double share = steps - static_cast<double>(next - 1);
  return {next, next == 0 || share > 1.0 - 1e-5 ? 1.0 : share};
}

Eigen::Vector3d rotation_vector(const std::array<double, 4>& from, const double* to) {
  const Eigen::Quaterniond a(from[0], from[1], from[2], from[3]), b(to[0], to[1], to[2], to[3]);
  const Eigen::AngleAxisd turn(a.conjugate() * b.normalized());
  double angle = turn.angle();
  if (angle > M_PI) angle -= 2.0 * M_PI;
  return angle * turn.axis();
}

}  // namespace

ReplayMode mode_of(const RobotModel& model, const Dataset& recording) {
  const auto any = [&](const char* quantity) {
    for (const MuscleModel& muscle : model.muscles) {
      if (!recording.series(muscle.name + quantity).empty()) return true;
    }
    return false;
  };
  if (any("/reference")) return ReplayMode::kReference;
  if (any("/voltage")) return ReplayMode::kVoltage;
  return ReplayMode::kPosition;
}

ChainExperiment::ChainExperiment(const RobotModel& model, const Dataset& recording,
                                 const ExperimentOptions& options, const ReplayScope& scope)
    : cut_off_(options.cut_off),
      rounding_(options.rounding),
      mode_(scope.mode.value_or(mode_of(model, recording))),
      input_(std::make_shared<RobotModel>(model), recording, mode_) {
  name_ = recording.folder;
  known_numbers_ = recording.meta.model;
  bin_ = scope.bin;
  duration_ = input_.duration();
  bins_ = bin_of(duration_) + 1;
  if (scope.seconds < duration_) {
    bins_ = std::max<std::size_t>(1, bin_of(scope.seconds));
    duration_ = static_cast<double>(bins_) * bin_;
  }
  fingerprint_ = resume::Fingerprint()
                     .add(recording)
                     .add(static_cast<std::uint64_t>(mode_))
                     .add(bin_)
                     .add(static_cast<std::uint64_t>(bins_))
                     .value();

  const bool imposed = mode_ == ReplayMode::kPosition || mode_ == ReplayMode::kPosture;
  const struct {
    const char *quantity, *unit;
    Reader::Kind kind;
  } quantities[] = {{"position", "rad", Reader::kPosition},
                    {"current", "A", Reader::kCurrent},
                    {"voltage", "V", Reader::kVoltage},
                    {"force", "N", Reader::kForce}};
  for (std::size_t m = 0; m < model.muscles.size(); ++m) {
    for (const auto& q : quantities) {
      // Without a controller it is the command, not an answer to it.
      const bool given = mode_ == ReplayMode::kVoltage || !model.muscles[m].has_controller;
      if (given && q.kind == Reader::kVoltage) continue;
      if (imposed && q.kind != Reader::kForce) continue;
      const std::string& name = model.muscles[m].name;
      add({q.kind, static_cast<int>(m), 0, {}, {}}, recording.series(name + "/" + q.quantity),
          {name, q.quantity, q.unit});
    }
  }
  for (std::size_t j = 0; mode_ != ReplayMode::kPosture && j < model.skeleton->joints.size(); ++j) {
    const JointModel& joint = model.skeleton->joints[j];
    if (joint.type == JointType::kBall) {
      add_ball(static_cast<int>(j), joint.name, recording);
    } else {
      add({Reader::kJoint, static_cast<int>(j), 0, {}, {}},
          recording.series(joint.name + "/position"),
          {joint.name, "position", joint.type == JointType::kHinge ? "rad" : "m"});
    }
  }
  if (channels_.empty()) {
    throw BadInput(recording.folder +
                   ": nothing to compare: expected measured columns in addition to the inputs");
  }
}

std::size_t ChainExperiment::bin_of(double time) const {
  return static_cast<std::size_t>(time / bin_ + 1e-9);
}

ChainExperiment::Sampling& ChainExperiment::sampling_of(const std::vector<double>& times) {
  for (std::size_t i = 0; i < times_.size(); ++i) {
    if (times_[i] == times) return samplings_[i];
  }
  times_.push_back(times);
  Sampling sampling;
  sampling.per_bin.assign(bins_, 0.0);
  for (const double t : times) {
    const std::size_t bin = bin_of(t);
    if (bin >= bins_) break;
    sampling.per_bin[bin] += 1.0;
    sampling.rows.push_back({t, static_cast<std::uint32_t>(bin)});
  }
  for (double& count : sampling.per_bin) count = count > 0.0 ? 1.0 / count : 0.0;
  samplings_.push_back(std::move(sampling));
  return samplings_.back();
}

double ChainExperiment::Sampling::rows_per_bin() const {
  double sum = 0.0, bins = 0.0;
  for (const double share : per_bin) {
    sum += share;
    bins += share > 0.0 ? 1.0 : 0.0;
  }
  return sum > 0.0 ? bins / sum : 1.0;
}

void ChainExperiment::add(Reader reader, const Series& series, const Channel& channel) {
  if (series.empty()) return;
  Sampling& sampling = sampling_of(series.t);
  reader.offset = present_.size();
  reader.mean.assign(bins_, 0.0);
  for (std::size_t i = 0; i < sampling.rows.size(); ++i) {
    const std::uint32_t bin = sampling.rows[i].bin;
    reader.mean[bin] += series.values[i] * sampling.per_bin[bin];
  }
  channels_.push_back(channel);
  channels_.back().offset = reader.offset;
  channels_.back().count = bins_;
  channels_.back().resolution = resolution_of(series.values);
  channels_.back().rows = sampling.rows_per_bin();
  channels_.back().digits = step_of_digits(series.values);
  channels_.back().rounding = rounding_of(series.values, channels_.back().rows, rounding_);
  if (reader.kind == Reader::kForce) {
    reader.noise = cut_off_noise(series, channels_.back().resolution, cut_off_);
  }
  for (const double share : sampling.per_bin) present_.push_back(share > 0.0);
  sampling.readers.push_back(std::move(reader));
}

void ChainExperiment::add_ball(int joint, const std::string& name, const Dataset& recording) {
  const OrientationSeries turns = OrientationSeries::read(recording, name);
  if (turns.empty()) return;
  Sampling& sampling = sampling_of(turns.t());
  Reader reader{Reader::kBall, joint, present_.size(), {}, {}};
  for (std::size_t i = 0; i < sampling.rows.size(); ++i) {
    const Series* q = turns.number;
    reader.rotation.push_back({q[0].values[i], q[1].values[i], q[2].values[i], q[3].values[i]});
  }
  for (int component = 0; component < 3; ++component) {
    channels_.push_back({name, "orientation", "rad", component, present_.size(), bins_});
    channels_.back().rows = sampling.rows_per_bin();
    // Of a small rotation's quaternion, the vector is half of the rotation vector.
    channels_.back().rounding =
        rounding_of(turns.number[1 + component].values, channels_.back().rows, 2.0 * rounding_);
    for (const double share : sampling.per_bin) present_.push_back(share > 0.0);
  }
  sampling.readers.push_back(std::move(reader));
}

void ChainExperiment::read(const Simulation& sim, const Sampling& sampling,
                           std::vector<double>& values) {
  values.clear();
  for (const Reader& reader : sampling.readers) {
    const int i = reader.index;
    switch (reader.kind) {
      case Reader::kPosition:
        values.push_back(sim.muscle(i).measured().position);
        break;
      case Reader::kCurrent:
        values.push_back(sim.muscle(i).measured().current);
        break;
      case Reader::kVoltage:
        values.push_back(sim.muscle(i).voltage());
        break;
      case Reader::kForce:
        values.push_back(mean_above_zero(sim.muscle(i).force_reading(), reader.noise));
        break;
      case Reader::kJoint:
        values.push_back(sim.measured_joint_position(i));
        break;
      case Reader::kBall: {
        const double* q = sim.read_positions() + sim.model().skeleton->joints[i].position_offset;
        values.insert(values.end(), q, q + 4);
        break;
      }
    }
  }
}

void ChainExperiment::finish_row(const Sampling& sampling, std::size_t row, double share,
                                 const std::vector<double>& before, const std::vector<double>& now,
                                 float* out) const {
  const Sampling::Row& at = sampling.rows[row];
  const double weight = sampling.per_bin[at.bin];
  const auto value = [&](std::size_t i) {
    return share == 1.0 ? now[i] : before[i] + share * (now[i] - before[i]);
  };
  std::size_t i = 0;
  for (const Reader& reader : sampling.readers) {
    if (reader.kind != Reader::kBall) {
      out[reader.offset + at.bin] += static_cast<float>(weight * value(i++));
      continue;
    }
    double q[4];
    for (int k = 0; k < 4; ++k) q[k] = value(i + static_cast<std::size_t>(k));
    i += 4;
    const Eigen::Vector3d turn = weight * rotation_vector(reader.rotation[row], q);
    for (int k = 0; k < 3; ++k) {
      out[reader.offset + static_cast<std::size_t>(k) * bins_ + at.bin] +=
          static_cast<float>(turn[k]);
    }
  }
}

void ChainExperiment::settle(const std::shared_ptr<const RobotModel>& model, Starts& starts) const {
  const auto [start, is_new] = starts.try_emplace(input_.start_inputs());
  if (!is_new) return;
  Simulation sim(model);
  start->second = input_.settle(sim);
}

void ChainExperiment::compare(const std::shared_ptr<const RobotModel>& model, const Starts& starts,
                              float* out) const {
  Simulation sim(model);
  input_.start(sim, starts.at(input_.start_inputs()));
  Replay::Run run(input_, sim);
  for (const Sampling& sampling : samplings_) {
    for (const Reader& reader : sampling.readers) {
      if (reader.kind == Reader::kBall) {
        std::fill_n(out + reader.offset, 3 * bins_, 0.0f);
      } else {
        for (std::size_t b = 0; b < bins_; ++b) {
          out[reader.offset + b] = static_cast<float>(-reader.mean[b]);
        }
      }
    }
  }

  const double h = model->step;
  std::vector<std::size_t> row(samplings_.size(), 0);
  std::vector<std::vector<double>> before(samplings_.size()), now(samplings_.size());
  const auto steps = static_cast<std::int64_t>(std::ceil(duration_ / h - 1e-6));
  for (std::int64_t k = 0; k <= steps; ++k) {
    if (k > 0) {
      run.drive(static_cast<double>(k - 1) * h);
      sim.step();
    }
    for (std::size_t i = 0; i < samplings_.size(); ++i) {
      const auto& rows = samplings_[i].rows;
      if (row[i] == rows.size()) continue;
      // A row between two steps needs the one before, too.
      const Moment next = moment(rows[row[i]].time, h);
      if (next.step > k + 1 || (next.step == k + 1 && next.share == 1.0)) continue;
      std::swap(before[i], now[i]);
      read(sim, samplings_[i], now[i]);
      while (row[i] < rows.size()) {
        const Moment at = moment(rows[row[i]].time, h);
        if (at.step > k) break;
        finish_row(samplings_[i], row[i]++, at.share, before[i], now[i], out);
      }
    }
  }
}

}  // namespace discovery
}  // namespace anthrob
