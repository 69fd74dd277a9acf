#include "identification/ring_report.h"

#include <algorithm>
#include <cstdio>

#include "anthrob_core/text.h"
#include "anthrob_recording/page.h"
#include "identification/number_text.h"
#include "identification/ring_figures.h"
#include "identification/ring_remarks.h"

namespace anthrob {
namespace identification {

namespace {

using nlohmann::ordered_json;

std::string commented(const Estimate& estimate, const std::string& unit, const std::string& name) {
  return significant(estimate.value, 6) + "  # [" + unit + "] " + name +
         ", 95 %: " + significant(estimate.lo, 6) + " to " + significant(estimate.hi, 6) + "\n";
}

std::string spring_yaml(const RingResult& ring, const RingModelResult& model) {
  const RingSpecimen& specimen = ring.recordings[ring.fitted].specimen;
  const auto& p = model.fit->parameters;
  std::string out = "  ring_" + ring.ring + (model.arms == 1 ? "" : "_wiechert") + ":\n";
  out += std::string("    type: ") + model.name() + "\n";
  out += "    rest_length: " + significant(specimen.rest_length, 6) + "  # [m]\n";
  out += "    section_diameter: " + significant(specimen.section_diameter, 6) + "  # [m]\n";
  out += "    strands: " + std::to_string(specimen.strands) + "\n";
  out += "    modulus: " + commented(p[0], "Pa", "E_0");
  if (model.arms == 1) {
    out += "    arm_modulus: " + commented(p[1], "Pa", "E_1");
    return out + "    relaxation_time: " + commented(p[2], "s", "tau_1");
  }
  out += "    arms:\n";
  for (std::size_t a = 1; a <= model.arms; ++a) {
    const std::string index = std::to_string(a);
    out += "      - modulus: " + commented(p[2 * a - 1], "Pa", "E_" + index);
    out += "        relaxation_time: " + commented(p[2 * a], "s", "tau_" + index);
  }
  return out;
}

std::string springs_yaml(const std::vector<RingResult>& rings) {
  std::string out = "# Identified by anthrob_identify see. Paste it into a model file.\nsprings:\n";
  for (const RingResult& ring : rings) {
    if (!ring.has_fit()) continue;
    out += "  # from " + ring.recordings[ring.fitted].name + "\n";
    for (const RingModelResult& model : ring.models) {
      if (model.fit) out += spring_yaml(ring, model);
    }
  }
  return out;
}

const char* unit_of(const std::string& parameter) {
  return parameter[0] == 'E' ? "Pa" : "s";
}

ordered_json level_json(const LevelFit& level, const std::vector<std::string>& names) {
  ordered_json out = {
      {"strain", level.strain}, {"used", level.used}, {"r_squared", level.r_squared}};
  for (std::size_t i = 0; i < names.size(); ++i) {
    out["parameters"][names[i]] = as_json(level.parameters[i], unit_of(names[i]));
  }
  return out;
}

ordered_json model_json(const RingModelResult& model) {
  ordered_json out = {{"model", model.name()}};
  if (!model.fit) {
    out["failure"] = model.failure;
    return out;
  }
  const ViscoelasticFit& fit = *model.fit;
  const auto names = parameter_names(model.arms);
  for (std::size_t i = 0; i < names.size(); ++i) {
    out["parameters"][names[i]] = as_json(fit.parameters[i], unit_of(names[i]));
    out["over_strains"][names[i]] = {{"mean", fit.over_levels[i].mean},
                                     {"deviation", fit.over_levels[i].deviation},
                                     {"unit", unit_of(names[i])}};
  }
  if (fit.zero) out["zero"] = as_json(*fit.zero, "m");
  if (const auto error = model.mean_fit_error()) out["rmse"]["fit_N"] = *error;
  if (const auto error = model.mean_validation_error()) out["rmse"]["validation_N"] = *error;
  out["strains"] = ordered_json::array();
  for (const LevelFit& level : fit.levels) out["strains"].push_back(level_json(level, names));
  return out;
}

ordered_json ring_json(const RingResult& ring) {
  const RingRecording& fitted = ring.recordings[ring.fitted];
  ordered_json out = {{"ring", ring.ring},
                      {"rest_length_m", fitted.specimen.rest_length},
                      {"section_diameter_m", fitted.specimen.section_diameter},
                      {"recording", fitted.name},
                      {"specimen", fitted.specimen.number},
                      {"run", fitted.run},
                      {"force_offset_N", fitted.force_offset},
                      {"models", ordered_json::array()}};
  for (const RingModelResult& model : ring.models) out["models"].push_back(model_json(model));
  if (ring.better()) out["better"] = ring.better()->name();
  out["remarks"] = remarks_on(ring);
  return out;
}

std::string error_text(const std::optional<double>& error) {
  return error ? significant(*error, 3) + " N" : "not measured";
}

}  // namespace

OutputFiles report_rings(const std::vector<RingResult>& rings) {
  OutputFiles files;
  ordered_json json = {{"command", "see"}, {"rings", ordered_json::array()}};
  for (const RingResult& ring : rings) {
    json["rings"].push_back(ring_json(ring));
    files["stress_strain_" + ring.ring + ".svg"] = stress_strain_figure(ring);
    for (const RingModelResult& model : ring.models) {
      if (!model.fit) continue;
      files[std::string(model.name()) + "_" + ring.ring + ".svg"] = model_figure(ring, model);
    }
  }
  if (rings.size() > 1) files["errors.svg"] = error_figure(rings);
  // Without a ring the key would be empty, which removes the springs of a model.
  const bool any = std::any_of(rings.begin(), rings.end(),
                               [](const RingResult& ring) { return ring.has_fit(); });
  if (any) files["springs.yaml"] = springs_yaml(rings);
  json["figures"] = figures_of(files);
  files["report.json"] = json.dump(2) + "\n";
  return files;
}

std::string summary_of_rings(const std::vector<RingResult>& rings) {
  std::string out;
  for (const RingResult& ring : rings) {
    for (const RingModelResult& model : ring.models) {
      out += ring.ring + " " + model.name() + ":";
      if (!model.fit) {
        out += " no fit: " + model.failure + "\n";
        continue;
      }
      const auto names = parameter_names(model.arms);
      for (std::size_t i = 0; i < names.size(); ++i) {
        const bool modulus = names[i][0] == 'E';
        out += (i > 0 ? ", " : " ") + names[i] + " " +
               with_error(model.fit->parameters[i], modulus ? 1e6 : 1.0) +
               (modulus ? " MPa" : " s");
      }
      out += "; RMSE " + error_text(model.mean_fit_error()) + ", second specimen " +
             error_text(model.mean_validation_error()) + "\n";
    }
    if (ring.better()) out += ring.ring + ": take " + ring.better()->name() + "\n";
    for (const std::string& remark : remarks_on(ring)) out += "remark: " + remark + "\n";
  }
  return out;
}

}  // namespace identification
}  // namespace anthrob
