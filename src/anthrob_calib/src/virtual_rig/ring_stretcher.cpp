#include "virtual_rig/ring_stretcher.h"

#include <cmath>

#include "anthrob_sim/model/robot_model.h"
#include "anthrob_sim/simulation.h"
#include "virtual_rig/virtual_recording.h"

namespace anthrob {
namespace virtual_rig {

namespace {

constexpr double kPeriod = 0.002;            // [s] of the desktop computer's controller
constexpr double kEffectiveRadius = 0.0129;  // [m] as found by experiment
constexpr double kStartForce = 3.0;          // [N] at which zero is set
constexpr double kFirstRelease = 5.0;        // [s] before the first test
constexpr double kLine = 0.3;                // [m] spindle to force sensor

/// A specimen as it is mounted, and what the operator believes of it.
struct Mounting {
  std::vector<double> parameters;
  double radius, start_length, believed_start_length, force_offset;
};

/// Different for every seed, ring type, specimen (and run): nothing random is shared by accident.
std::uint64_t stream_of(const RingTruth& truth, const StretchOptions& options, int run) {
  std::uint64_t stream = static_cast<std::uint64_t>(1000 * options.specimen + run);
  for (const char c : truth.name) stream = 31 * stream + static_cast<unsigned char>(c);
  return stream;
}

Mounting mount(const RingTruth& truth, const StretchOptions& options) {
  Deviations rig(options.seed, 0);
  Deviations own(options.seed, stream_of(truth, options, 0));
  Mounting m;
  m.radius = kEffectiveRadius * (1.0 + rig.next(options.radius_sigma));
  const double batch = own.next(options.batch_sigma);
  m.parameters = truth.parameters;
  for (std::size_t i = 0; i < m.parameters.size(); ++i) {
    const bool modulus = i == 0 || i % 2 == 1;
    if (modulus && options.specimen > 1) m.parameters[i] *= 1.0 + batch;
  }
  const double area = 0.5 * M_PI * truth.section_diameter * truth.section_diameter;
  m.start_length = truth.rest_length * (1.0 + kStartForce / (area * m.parameters[0]));
  m.believed_start_length = m.start_length + own.next(options.calliper_sigma);
  m.force_offset = own.next(options.force_offset_sigma);
  return m;
}

std::shared_ptr<const RobotModel> model_of(const std::string& rig, const RingTruth& truth,
                                           const StretchOptions& options, const Mounting& mounted) {
  LoadOptions load;
  load.step = kPeriod;
  auto& set = load.overrides;
  set["springs.ring.rest_length"] = truth.rest_length;
  set["springs.ring.section_diameter"] = truth.section_diameter;
  set["springs.ring.modulus"] = mounted.parameters[0];
  const bool zener = truth.parameters.size() == 3;
  const std::string arm = "springs.ring.arms.";
  set[zener ? "springs.ring.arm_modulus" : arm + "0.modulus"] = mounted.parameters[1];
  set[zener ? "springs.ring.relaxation_time" : arm + "0.relaxation_time"] = mounted.parameters[2];
  if (!zener) {
    set[arm + "1.modulus"] = mounted.parameters[3];
    set[arm + "1.relaxation_time"] = mounted.parameters[4];
  }
  set["muscles.ring.spindle_radius"] = mounted.radius;
  set["muscles.ring.rest_tendon_length"] = kLine - mounted.start_length;
  const std::uint64_t noise = 1009 * options.seed + stream_of(truth, options, options.run);
  set["sensors.seed"] = static_cast<double>(noise % 2147483647);
  return load_robot_model(rig + (zener ? "/model_I.yaml" : "/model_II.yaml"), load);
}

void describe(const RingTruth& truth, const StretchOptions& options, const Mounting& mounted,
              DatasetMeta& meta) {
  meta.robot = "rig_oring_stretcher";
  meta.kind = "rig";
  meta.rate = 1.0 / kPeriod;
  meta.other["specimen"] =
      "{ring: " + truth.name + ", number: " + std::to_string(options.specimen) +
      ", rest_length: " + exact_text(truth.rest_length) +
      ", section_diameter: " + exact_text(truth.section_diameter) + ", strands: 2}\n";
  meta.other["rig"] = "{effective_radius: " + exact_text(kEffectiveRadius) +
                      ", start_length: " + exact_text(mounted.believed_start_length) +
                      ", scale_sigma: " + exact_text(options.radius_sigma) +
                      ", force_average: 20}\n";
  meta.other["protocol"] =
      "{hold: " + exact_text(options.hold) + ", recover: " + exact_text(options.recover) + "}\n";
  meta.other["run"] = std::to_string(options.run) + "\n";
  meta.other["notes"] =
      "simulated by anthrob_virtual_rig, seed " + std::to_string(options.seed) + "\n";
}

}  // namespace

RingTruth RingTruth::load(const std::string& rig, const std::string& name, int arms) {
  const ConfigNode node = ConfigNode::load(rig + "/rings.yaml").at(name);
  const ConfigNode model = node.at(arms == 1 ? "zener" : "wiechert");
  RingTruth truth{name,
                  node.number("rest_length", Bounds::positive(), "m"),
                  node.number("section_diameter", Bounds::positive(), "m"),
                  {},
                  {}};
  for (const ConfigNode& item : model.at("mean").items()) {
    truth.parameters.push_back(item.as_number(Bounds::positive(), "Pa or s"));
  }
  for (const ConfigNode& item : model.at("sigma").items()) {
    truth.sigma.push_back(item.as_number(Bounds::positive(), "Pa or s"));
  }
  return truth;
}

std::vector<std::string> ring_names(const std::string& rig) {
  std::vector<std::string> names;
  for (const auto& entry : ConfigNode::load(rig + "/rings.yaml").entries()) {
    names.push_back(entry.first);
  }
  return names;
}

Dataset stretch_ring(const std::string& rig, const RingTruth& truth,
                     const StretchOptions& options) {
  const Mounting mounted = mount(truth, options);
  Simulation sim(model_of(rig, truth, options, mounted));
  Dataset data;
  describe(truth, options, mounted, data.meta);
  RowWriter rows(data.table("muscles"),
                 {"ring/reference", "ring/position", "ring/voltage", "ring/force"});

  const auto run = [&](double strain, double duration) {
    // The operator's zero is off by the error of the calliper.
    const double length = truth.rest_length * (1.0 + strain);
    const double reference = (length - mounted.believed_start_length) / kEffectiveRadius;
    sim.command(0, ecu::Mode::kPosition, reference);
    for (auto steps = std::lround(duration / kPeriod); steps > 0; --steps) {
      const Muscle& ring = sim.muscle(0);
      rows.add(sim.time(), {reference, ring.measured().position, ring.voltage(),
                            ring.measured().force + mounted.force_offset});
      sim.step();
    }
  };
  run(0.0, kFirstRelease);
  for (int level = 1; level <= options.levels; ++level) {
    run(options.max_strain * level / options.levels, options.hold);
    run(0.0, options.recover);
  }
  return data;
}

}  // namespace virtual_rig
}  // namespace anthrob
