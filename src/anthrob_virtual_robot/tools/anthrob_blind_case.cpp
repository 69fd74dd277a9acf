// One case of a blind test of discovery: recordings of a robot with something hidden, the model it
// is believed to be, and, elsewhere, the truth.
#include <filesystem>
#include <fstream>
#include <iostream>
#include <stdexcept>

#include "anthrob_core/files.h"
#include "blind_case.h"
#include "tool.h"

namespace {

using namespace anthrob::virtual_robot;

void write(const std::filesystem::path& file, const std::string& text) {
  if (file.has_parent_path()) std::filesystem::create_directories(file.parent_path());
  std::ofstream stream(file);
  stream << text;
  stream.close();
  if (!stream) throw std::runtime_error(file.string() + ": cannot be written");
}

void list_laws() {
  for (const auto* laws : {&catalogue_laws(), &outside_laws()}) {
    for (const HiddenLaw& law : *laws) {
      std::cout << (laws == &outside_laws() ? "outside  " : "effect   ") << law.id << ": "
                << law.law << "\n";
    }
  }
}

/// "joint_coulomb@elbow" -> both words
std::pair<std::string, std::string> law_and_place(const std::string& text) {
  const std::size_t at = text.find('@');
  if (at == std::string::npos) {
    throw std::invalid_argument("--hide " + text + ": expected ID@PLACE");
  }
  return {text.substr(0, at), text.substr(at + 1)};
}

/// One way to write it, whether it exists or not.
std::filesystem::path whole(const std::string& path) {
  const auto all = anthrob::place_of(path);
  return all.has_filename() ? all : all.parent_path();
}

/// The truth must not lie in the folder that discovery gets.
void refuse_inside(const std::string& truth, const std::string& out) {
  const auto folder = whole(out);
  auto file = whole(truth);
  while (file.has_relative_path()) {
    if (file == folder)
      throw std::invalid_argument("--truth " + truth + ": expected a file outside --out");
    file = file.parent_path();
  }
}

/// Refuses a folder that holds other recordings: they would count as those of this robot.
void refuse_recordings(const std::string& out) {
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(out, none)) {
    if (!entry.is_directory()) continue;
    throw std::invalid_argument("--out " + out + ": holds " + entry.path().filename().string() +
                                "; expected a new or an empty folder");
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app(
      "Makes one case of a blind test of discovery: recordings of a virtual robot with hidden "
      "effects, the model without them, and the truth in a separate file.",
      "anthrob_blind_case");
  std::string kind = "effect", out, truth, model, config;
  std::uint64_t number = 0, seed = 1;
  std::vector<std::string> hide;
  bool list = false;
  auto* kind_option = app.add_option(
      "--kind", kind,
      "what is hidden: effect (one of the catalogue), null (nothing), pair (two effects), "
      "outside (one that the catalogue lacks), wrapped (all muscles wrap around bones)");
  auto* number_option =
      app.add_option("--case", number,
                     "number of the case: successive numbers take the next law, then other places")
          ->check(anthrob::tool::within(0.0, 1e12));
  app.add_option("--seed", seed, "seed of all random choices")
      ->check(anthrob::tool::within(0.0, 1e12));
  app.add_option("--hide", hide,
                 "ID@PLACE: hide this instead of what --case selects; may be repeated")
      ->excludes(kind_option)
      ->excludes(number_option);
  app.add_option("--model", model, "model of the robot without what is hidden")
      ->transform(anthrob::tool::model_or_file());
  app.add_option("--config", config, "settings; default: virtual_robot.yaml beside the model");
  app.add_option("--out", out, "folder for recordings and model.yaml");
  app.add_option("--truth", truth, "file for the truth, outside of --out");
  app.add_flag("--list", list, "list what can be hidden");
  return run_tool(app, argc, argv, [&] {
    if (list) return list_laws();
    if (out.empty() || truth.empty() || model.empty()) {
      throw std::invalid_argument("expected --model, --out and --truth, or --list");
    }
    refuse_inside(truth, out);
    refuse_recordings(out);
    const auto model_file = std::filesystem::weakly_canonical(model);
    const auto believed = load_arm(model_file.string());
    CaseSettings settings = CaseSettings::load(
        config.empty() ? (model_file.parent_path() / "virtual_robot.yaml").string() : config);
    settings.ordinary = anthrob::ordinary_parameters(model_file.string());
    std::vector<std::pair<std::string, std::string>> hidden;
    for (const std::string& text : hide) hidden.push_back(law_and_place(text));
    const BlindCase blind = hidden.empty()
                                ? draw_case(case_kind(kind), number, seed, believed, settings)
                                : make_case(hidden, seed, believed, settings);
    record_case(blind, settings, out);
    write(std::filesystem::path(out) / "model.yaml", "extends: " + model_file.string() + "\n");
    write(truth, truth_text(blind));
  });
}
