// The effect catalogue: lists and explains, and says where an effect can sit on a robot.
#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <iomanip>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "anthrob_core/errors.h"
#include "anthrob_core/text.h"
#include "anthrob_sim/effects/catalogue.h"
#include "anthrob_sim/tool.h"

namespace anthrob {
namespace {

using Json = nlohmann::ordered_json;

const char* kind_name(EffectParameter::Kind kind) {
  return kind == EffectParameter::kSize    ? "size"
         : kind == EffectParameter::kShape ? "shape"
                                           : "given";
}

/// Breaks a paragraph into lines of at most 90 letters.
std::string wrapped(const std::string& paragraph, const std::string& indent) {
  std::istringstream words(paragraph);
  std::string word, line, text;
  while (words >> word) {
    if (!line.empty() && line.size() + word.size() > 89) {
      text += indent + line + "\n";
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return text + indent + line + "\n";
}

/// An effect by itself, or as it is at its places on one robot.
struct View {
  const Effect* effect;
  const RobotModel* robot;  ///< null: none given

  std::vector<std::string> places() const {
    return robot ? effect->places(*robot) : std::vector<std::string>();
  }
};

void print_list(const std::vector<View>& views) {
  for (const View& view : views) {
    const EffectInfo& info = view.effect->info();
    std::printf("%-25s %-12s %s", info.id.c_str(), seam_name(info.seam).c_str(), info.name.c_str());
    if (view.robot) std::printf(" (%zu places)", view.places().size());
    std::printf("\n");
  }
}

/// One line of the table, however long its last column.
std::string row(const std::string& name, const std::string& unit, const std::string& kind,
                const std::string& neutral, const std::string& typical, const std::string& bounds,
                const std::string& meaning) {
  std::ostringstream line;
  line << std::left << "  " << std::setw(20) << name << " " << std::setw(9) << unit << " "
       << std::setw(6) << kind << " " << std::setw(10) << neutral << " " << std::setw(10) << typical
       << " " << std::setw(22) << bounds << " " << meaning << "\n";
  return line.str();
}

std::string number(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

std::string table(const std::vector<EffectParameter>& parameters) {
  std::string text = row("parameter", "unit", "kind", "neutral", "typical", "bounds", "meaning");
  for (const EffectParameter& p : parameters) {
    const std::string bounds =
        (p.bounds.lo_open ? "(" : "[") + number(p.bounds.lo) + ", " + number(p.bounds.hi) + "]";
    text += row(p.name, p.unit, kind_name(p.kind), number(p.neutral), number(p.typical), bounds,
                p.meaning);
  }
  return text;
}

void explain(const View& view) {
  const EffectInfo& info = view.effect->info();
  std::cout << info.id << ": " << info.name << "\n\n" << wrapped(info.description, "  ") << "\n";
  std::cout << wrapped(info.equation, "    ") << "\n";
  std::cout << "  source:     " << info.source << "\n  seam:       " << seam_name(info.seam)
            << "\n  places:     " << info.where << "\n  shows in:   " << joined(info.channels)
            << "\n  dissipates: " << (info.dissipates ? "yes" : "no")
            << (info.slow ? "\n  slow:       builds up over minutes" : "") << "\n\n";
  // Bounds may differ from place to place, as room for a surface does.
  std::vector<std::pair<std::string, std::vector<std::string>>> groups;
  for (const std::string& place : view.places()) {
    const std::string there = table(view.effect->parameters_at(*view.robot, place));
    const auto group = std::find_if(groups.begin(), groups.end(),
                                    [&](const auto& known) { return known.first == there; });
    if (group != groups.end()) {
      group->second.push_back(place);
    } else {
      groups.push_back({there, {place}});
    }
  }
  if (groups.empty()) std::cout << table(info.parameters);
  if (groups.empty() && view.robot) std::cout << "\n  this robot has no place for it\n";
  for (std::size_t g = 0; g < groups.size(); ++g) {
    std::cout << (g > 0 ? "\n" : "") << groups[g].first << "\n  on this robot at:\n"
              << wrapped(joined(groups[g].second), "    ");
  }
}

Json to_json(const EffectParameter& p) {
  return {{"name", p.name},       {"unit", p.unit},       {"kind", kind_name(p.kind)},
          {"neutral", p.neutral}, {"typical", p.typical}, {"bounds", {p.bounds.lo, p.bounds.hi}},
          {"meaning", p.meaning}};
}

Json to_json(const View& view) {
  const EffectInfo& info = view.effect->info();
  Json object = {{"id", info.id},
                 {"name", info.name},
                 {"description", info.description},
                 {"equation", info.equation},
                 {"source", info.source},
                 {"seam", seam_name(info.seam)},
                 {"where", info.where},
                 {"channels", info.channels},
                 {"dissipates", info.dissipates},
                 {"slow", info.slow}};
  for (const EffectParameter& p : info.parameters) object["parameters"].push_back(to_json(p));
  if (!view.robot) return object;
  object["places"] = Json::array();
  for (const std::string& place : view.places()) {
    Json entry = {{"place", place}};
    for (const EffectParameter& p : view.effect->parameters_at(*view.robot, place)) {
      entry["parameters"].push_back(to_json(p));
    }
    object["places"].push_back(entry);
  }
  return object;
}

/// A row of the table in docs/effects.md.
void print_row(const View& view) {
  const EffectInfo& info = view.effect->info();
  std::string parameters;
  for (const EffectParameter& p : info.parameters) {
    char text[128];
    // Of terms of a series, the first and the names of the last.
    const auto number = p.name.rfind('_') + 1;
    if (number > 0 && std::atoi(p.name.c_str() + number) > 1) continue;
    std::snprintf(text, sizeof(text), "%s`%s` %g %s", parameters.empty() ? "" : ", ",
                  p.name.c_str(), p.typical, p.unit == "1" ? "" : p.unit.c_str());
    parameters += text;
    while (parameters.back() == ' ') parameters.pop_back();
  }
  const std::string& last = info.parameters.back().name;
  if (std::isdigit(static_cast<unsigned char>(last.back()))) parameters += ", ... `" + last + "`";
  std::string where = info.where;
  for (std::size_t at; (at = where.find(" | ")) != std::string::npos;) where.replace(at, 3, ", ");
  std::string equation = info.equation;
  for (std::size_t at = 0; (at = equation.find('|', at)) != std::string::npos; at += 2) {
    equation.replace(at, 1, "\\|");
  }
  std::cout << "| `" << info.id << "` | " << info.name << " | " << equation << " | " << parameters
            << " | " << where << " | " << joined(info.channels) << " | "
            << (info.dissipates ? "yes" : "no") << " |\n";
}

}  // namespace
}  // namespace anthrob

int main(int argc, char** argv) {
  using namespace anthrob;
  CLI::App app("Lists and explains the effects that a model file can have under 'effects:'.",
               "anthrob_effects");
  std::string id, model_file, format = "text";
  app.add_option("id", id, "explain this effect; without an id, list all effects");
  app.add_option("--model", model_file,
                 "model: show at which places of this robot each effect can act")
      ->transform(tool::model_or_file());
  app.add_option("--format", format, "output format")
      ->check(CLI::IsMember({"text", "json", "markdown"}))
      ->capture_default_str();
  return tool::run(app, argc, argv, [&]() -> int {
    std::shared_ptr<const RobotModel> robot;
    if (!model_file.empty()) robot = tool::load_model(app, model_file);
    std::vector<View> views;
    for (const Effect* effect : all_effects()) {
      if (id.empty() || effect->info().id == id) views.push_back({effect, robot.get()});
    }
    if (views.empty())
      throw BadInput(
          id + ": expected the id of an effect; run anthrob_effects without an id to list all");
    if (format == "json") {
      Json list = Json::array();
      for (const View& view : views) list.push_back(to_json(view));
      std::cout << list.dump(2) << "\n";
    } else if (format == "markdown") {
      for (const View& view : views) print_row(view);
    } else if (id.empty()) {
      print_list(views);
    } else {
      explain(views.front());
    }
    return tool::kDone;
  });
}
