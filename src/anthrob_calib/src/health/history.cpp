#include "health/history.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "anthrob_core/errors.h"
#include "anthrob_core/files.h"
#include "anthrob_core/text.h"
#include "anthrob_recording/table.h"

namespace anthrob {
namespace health {

namespace {

constexpr double kDay = 86400.0;  // [s]
const char* const kHead = "time,muscle,quantity,value,low,high,unit";

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream stream(line);
  std::string cell;
  while (std::getline(stream, cell, ',')) cells.push_back(trimmed(cell));
  return cells;
}

Quantity quantity_of(const std::string& name) {
  for (int k = 0; k < kQuantities; ++k) {
    if (name == name_of(static_cast<Quantity>(k))) return static_cast<Quantity>(k);
  }
  throw BadInput("quantity " + name + ": expected one such as stiffness or creep");
}

double number_in(const std::string& cell) {
  char* end = nullptr;
  const double value = std::strtod(cell.c_str(), &end);
  if (cell.empty() || *end != '\0' || !std::isfinite(value)) {
    throw BadInput("'" + cell + "': expected a number");
  }
  return value;
}

}  // namespace

double present_day() {
  return static_cast<double>(std::time(nullptr)) / kDay;
}

std::string time_of_day(double day) {
  const auto seconds = static_cast<std::time_t>(std::llround(kDay * day));
  std::tm parts{};
  gmtime_r(&seconds, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

double day_of(const std::string& time) {
  std::tm parts{};
  const char* rest = strptime(time.c_str(), "%Y-%m-%d", &parts);
  if (rest != nullptr && *rest != '\0') rest = strptime(rest, "T%H:%M:%SZ", &parts);
  if (rest == nullptr || *rest != '\0') {
    throw BadInput("'" + time + "': expected a time in UTC, such as 2026-12-01T08:30:00Z");
  }
  return static_cast<double>(timegm(&parts)) / kDay;
}

History History::load(const std::string& file) {
  History history;
  std::ifstream in(file);
  if (!in) {
    if (std::filesystem::exists(file)) throw BadInput(file + ": cannot be read");
    return history;
  }
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    line = trimmed(line);
    try {
      if (number == 1) {
        if (line != kHead) throw BadInput("'" + line + "': expected " + kHead);
        continue;
      }
      if (line.empty()) continue;
      const auto cells = cells_of(line);
      if (cells.size() != 7) throw BadInput("expected 7 cells: " + std::string(kHead));
      const Quantity quantity = quantity_of(cells[2]);
      if (cells[6] != unit_of(quantity)) {
        throw BadInput("unit " + cells[6] + ": expected " + unit_of(quantity));
      }
      const double day = day_of(cells[0]);
      if (day < history.last_day_)
        throw BadInput("time " + cells[0] + ": before that of a line above");
      history.add(day, cells[1],
                  {quantity, number_in(cells[3]), number_in(cells[4]), number_in(cells[5])});
    } catch (const BadInput& error) {
      throw BadInput(file + ": line " + std::to_string(number) + ": " + error.what());
    }
  }
  return history;
}

void History::add(double day, const std::string& muscle, const Figure& figure) {
  if (std::find(muscles_.begin(), muscles_.end(), muscle) == muscles_.end()) {
    muscles_.push_back(muscle);
  }
  series_[{muscle, figure.quantity}].push_back({day, figure});
  last_day_ = std::max(last_day_, day);
}

void History::add(double day, const std::vector<TendonFigures>& tendons) {
  if (last_day_ > 0.0 && kDay * (day - last_day_) < 0.5) {
    throw BadInput("a test at " + time_of_day(day) + ": expected one after that of " +
                   time_of_day(last_day_));
  }
  for (const TendonFigures& tendon : tendons) {
    for (const Figure& figure : tendon.figures) add(day, tendon.muscle, figure);
  }
}

void History::save(const std::string& file) const {
  struct Line {
    double day;
    std::string text;
  };
  std::vector<Line> lines;
  for (const std::string& muscle : muscles_) {
    for (int k = 0; k < kQuantities; ++k) {
      const auto quantity = static_cast<Quantity>(k);
      for (const Test& test : series(muscle, quantity)) {
        lines.push_back(
            {test.day, time_of_day(test.day) + "," + muscle + "," + name_of(quantity) + "," +
                           exact_text(test.figure.value) + "," + exact_text(test.figure.low) + "," +
                           exact_text(test.figure.high) + "," + unit_of(quantity) + "\n"});
      }
    }
  }
  std::stable_sort(lines.begin(), lines.end(),
                   [](const Line& a, const Line& b) { return a.day < b.day; });
  std::string text = std::string(kHead) + "\n";
  for (const Line& line : lines) text += line.text;
  write_file_atomically(file, text);
}

const History::Series& History::series(const std::string& muscle, Quantity quantity) const {
  static const Series none;
  const auto found = series_.find({muscle, quantity});
  return found == series_.end() ? none : found->second;
}

}  // namespace health
}  // namespace anthrob
