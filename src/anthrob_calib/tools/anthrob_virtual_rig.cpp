// Recordings of the rigs, simulated with known parameters and with what real rigs add.
#include <algorithm>
#include <filesystem>
#include <iostream>

#include "anthrob_core/errors.h"
#include "anthrob_core/robots.h"
#include "anthrob_sim/tool.h"
#include "virtual_rig/eyelet_pull.h"
#include "virtual_rig/load_resistor.h"
#include "virtual_rig/ring_stretcher.h"

namespace anthrob {
namespace {

using namespace virtual_rig;

std::string rig_folder(const std::string& robot) {
  return std::filesystem::path(find_model_file(robot, "I")).parent_path().string();
}

void save(const Dataset& data, const std::string& folder) {
  data.save(folder);
  std::cout << folder << "\n";
}

struct RingChoice {
  std::vector<std::string> rings;
  std::string truth = "zener";
  StretchOptions options;
};

/// Two runs of the first specimen, one of the second, as in section 7.2.3.
void make_ring_recordings(RingChoice choice, std::uint64_t seed, const std::string& out) {
  const std::string rig = rig_folder("rig_oring_stretcher");
  const std::vector<std::string> known = ring_names(rig);
  if (choice.rings.empty()) choice.rings = known;
  for (const std::string& ring : choice.rings) {
    if (std::count(known.begin(), known.end(), ring) > 0) continue;
    std::string names;
    for (const std::string& name : known) names += (names.empty() ? "" : ", ") + name;
    throw BadInput("--ring " + ring + ": expected one of: " + names);
  }
  choice.options.seed = seed;
  for (const std::string& ring : choice.rings) {
    const RingTruth truth = RingTruth::load(rig, ring, choice.truth == "zener" ? 1 : 2);
    for (const auto& [specimen, run] : {std::pair{1, 1}, std::pair{1, 2}, std::pair{2, 1}}) {
      choice.options.specimen = specimen;
      choice.options.run = run;
      save(stretch_ring(rig, truth, choice.options), out + "/" + ring + "_specimen_" +
                                                         std::to_string(specimen) + "_run_" +
                                                         std::to_string(run));
    }
  }
}

/// Four weights, pulled and relaxed, over two eyelets.
void make_eyelet_recordings(const PullOptions& given, double pulling, double relaxing,
                            std::uint64_t seed, const std::string& out) {
  const std::string rig = rig_folder("rig_eyelet_pull");
  PullOptions options = given;
  options.seed = seed;
  for (const int specimen : {1, 2}) {
    for (const double load : thesis_loads()) {
      for (const bool pull : {true, false}) {
        options.specimen = specimen;
        options.load = load;
        options.pulling = pull;
        options.friction = pull ? pulling : relaxing;
        std::string name = exact_text(load) + "N_" + (pull ? "pulling" : "relaxing");
        name[name.find('.')] = '_';
        save(pull_over_eyelet(rig, options),
             out + "/eyelet_" + std::to_string(specimen) + "_" + name);
      }
    }
  }
}

/// Two load resistors on two ECUs.
void make_ecu_recordings(double resistance, std::uint64_t seed, const std::string& out) {
  const std::string rig = rig_folder("rig_ecu_load");
  EcuLoadOptions options;
  options.seed = seed;
  options.series_resistance = resistance;
  for (const int specimen : {1, 2}) {
    for (const double load : {0.33, 0.66}) {
      options.specimen = specimen;
      options.load_resistance = load;
      save(load_ecu(rig, options),
           out + "/ecu_" + std::to_string(specimen) + (load < 0.5 ? "_load_0_33" : "_load_0_66"));
    }
  }
}

}  // namespace
}  // namespace anthrob

int main(int argc, char** argv) {
  using namespace anthrob;
  CLI::App app(
      "Simulates recordings of the test rigs for anthrob_identify, by the protocols of the thesis.",
      "anthrob_virtual_rig");
  app.require_subcommand(1);
  std::string out;
  std::uint64_t seed = 1;
  RingChoice rings;
  PullOptions pull;
  double pulling = 0.170, relaxing = 0.141, resistance = 0.12;
  const auto add = [&](const char* name, const char* description) {
    CLI::App* command = app.add_subcommand(name, description);
    command->add_option("--out", out, "folder for the recordings")->required();
    command->add_option("--seed", seed, "seed of the noise and of the rig's deviations")
        ->check(tool::within(0.0, 1e12));
    return command;
  };
  CLI::App* see = add("see", "rubber rings on the stretcher");
  see->add_option("--ring", rings.rings,
                  "type of ring: 10x4, 10x5, ...; default: all of rings.yaml");
  see->add_option("--truth", rings.truth, "material model of the simulated rings")
      ->check(CLI::IsMember({"zener", "wiechert"}));
  see->add_option("--levels", rings.options.levels, "relaxation tests per run")
      ->check(CLI::Range(1, 100));
  CLI::App* eyelet = add("eyelet", "line, eyelet and weights");
  eyelet->add_option("--pulling", pulling, "friction coefficient mu_k while pulling [1]")
      ->check(tool::within(0.0, 1.0));
  eyelet->add_option("--relaxing", relaxing, "friction coefficient mu_k while relaxing [1]")
      ->check(tool::within(0.0, 1.0));
  CLI::App* ecu = add("ecu", "power stage with load resistors");
  ecu->add_option("--resistance", resistance, "R_ECU, series resistance of the power stage [ohm]")
      ->check(tool::within(0.0, 1.0));
  return tool::run(app, argc, argv, [&]() -> int {
    if (see->parsed()) make_ring_recordings(rings, seed, out);
    if (eyelet->parsed()) make_eyelet_recordings(pull, pulling, relaxing, seed, out);
    if (ecu->parsed()) make_ecu_recordings(resistance, seed, out);
    return tool::kDone;
  });
}
