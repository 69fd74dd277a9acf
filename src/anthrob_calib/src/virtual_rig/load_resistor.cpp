#include "virtual_rig/load_resistor.h"

#include <algorithm>
#include <cmath>

#include "anthrob_sim/model/robot_model.h"
#include "anthrob_sim/simulation.h"
#include "virtual_rig/virtual_recording.h"

namespace anthrob {
namespace virtual_rig {

namespace {

constexpr double kSampling = 1e-4;      // [s] of the oscilloscope
constexpr double kVoltageLimit = 12.0;  // [V] of the ECU

double counted(double value, double count) {
  return count > 0.0 ? count * std::round(value / count) : value;
}

}  // namespace

Dataset load_ecu(const std::string& rig, const EcuLoadOptions& options) {
  Deviations of_instruments(options.seed, 0);
  Deviations of_ecu(options.seed, static_cast<std::uint64_t>(options.specimen));
  const auto recording = static_cast<std::uint64_t>(1000 * options.specimen +
                                                    std::lround(100.0 * options.load_resistance));
  Deviations of_resistor(options.seed, 1000000 + recording);
  Deviations noise(options.seed, 2000000 + recording);
  const double voltage_gain = 1.0 + of_instruments.next(options.voltage_gain_sigma);
  const double voltage_offset = of_instruments.next(options.voltage_offset_sigma);
  const double current_gain = 1.0 + of_instruments.next(options.current_gain_sigma);
  const double current_offset = of_instruments.next(options.current_offset_sigma);
  const double batch = 1.0 + of_ecu.next(options.batch_sigma);

  LoadOptions load;
  load.step = kSampling;
  load.overrides["actuators.resistor.motor.resistance"] =
      options.load_resistance * (1.0 + of_resistor.next(options.resistor_sigma));
  const double series = options.series_resistance * (options.specimen > 1 ? batch : 1.0);
  load.overrides["actuators.resistor.power_stage.resistance"] = series;
  Simulation sim(load_robot_model(rig + "/model_I.yaml", load));

  Dataset data;
  data.meta.robot = "rig_ecu_load";
  data.meta.kind = "rig";
  data.meta.rate = 1.0 / kSampling;
  data.meta.other["specimen"] = "{number: " + std::to_string(options.specimen) + "}\n";
  data.meta.other["rig"] = "{load_resistance: " + exact_text(options.load_resistance) +
                           ", current_gain_sigma: " + exact_text(options.current_gain_sigma) +
                           "}\n";
  data.meta.other["notes"] =
      "simulated by anthrob_virtual_rig, seed " + std::to_string(options.seed) + "\n";
  RowWriter rows(data.table("rig"), {"resistor/reference", "resistor/voltage",
                                     "oscilloscope/voltage", "oscilloscope/current"});

  const auto levels = std::lround(options.max_current / options.current_step);
  for (long level = -levels; level <= levels; ++level) {
    const double wanted = static_cast<double>(level) * options.current_step *
                          (options.load_resistance + options.series_resistance);
    const double reference = std::clamp(wanted, -kVoltageLimit, kVoltageLimit);
    sim.command(0, ecu::Mode::kVoltage, reference);
    for (auto steps = std::lround(options.level / kSampling); steps > 0; --steps) {
      sim.step();
      const double current = sim.muscle(0).actuator().current;
      const double at_load = sim.muscle(0).voltage() - series * current;
      rows.add(sim.time(),
               {reference, sim.muscle(0).voltage(),
                counted(voltage_gain * at_load + voltage_offset + noise.next(options.voltage_noise),
                        options.voltage_count),
                counted(current_gain * current + current_offset + noise.next(options.current_noise),
                        options.current_count)});
    }
  }
  return data;
}

}  // namespace virtual_rig
}  // namespace anthrob
