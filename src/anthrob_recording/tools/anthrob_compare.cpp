// How far two recordings lie apart, channel by channel, in numbers and as a figure.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>

#include "anthrob_core/command_line.h"
#include "anthrob_core/errors.h"
#include "anthrob_core/files.h"
#include "anthrob_core/pose.h"
#include "anthrob_recording/bag.h"
#include "anthrob_recording/unanswered.h"
#include "comparison/comparison.h"
#include "plot/recording_lines.h"

namespace anthrob {
namespace {

struct Arguments {
  std::string a, b, out;
  std::vector<std::string> channels;
};

Dataset recording_of(const CLI::App& app, const std::string& path) {
  Dataset data = load_recording(path);
  tool::say(app, data.remarks);
  leave_out_unanswered(data);
  leave_out_orientations_without_answer(data);
  return data;
}

/// Whether a channel is one of those that were asked for: itself, all of its owner's, or all of its
/// quantity.
bool is_asked_for(const std::string& channel, const std::vector<std::string>& asked) {
  const std::size_t slash = channel.find('/');
  const std::string owner = channel.substr(0, slash),
                    quantity = slash == std::string::npos ? "" : channel.substr(slash + 1);
  return asked.empty() || std::any_of(asked.begin(), asked.end(), [&](const std::string& one) {
           return one == channel || one == owner || one == quantity;
         });
}

/// @throws BadInput if nothing is left
void choose(Comparison& comparison, const Arguments& arguments) {
  auto& channels = comparison.channels;
  if (channels.empty()) {
    throw BadInput(arguments.a + ", " + arguments.b + ": expected recordings with common channels");
  }
  const auto drop = [&](const ChannelDifference& difference) {
    return !is_asked_for(difference.channel, arguments.channels);
  };
  for (const std::string& asked : arguments.channels) {
    const bool known = std::any_of(
        channels.begin(), channels.end(),
        [&](const ChannelDifference& one) { return is_asked_for(one.channel, {asked}); });
    if (!known) {
      throw BadInput("--channel " + asked +
                     ": not in both recordings; expected NAME/QUANTITY, a NAME or a QUANTITY");
    }
  }
  channels.erase(std::remove_if(channels.begin(), channels.end(), drop), channels.end());
}

void print(const Comparison& comparison) {
  std::size_t width = 7;
  for (const auto& one : comparison.channels) width = std::max(width, one.channel.size());
  const int w = static_cast<int>(width);
  std::printf("%-*s  %12s  %12s  %9s  %8s  unit\n", w, "channel", "rms", "largest", "at [s]",
              "samples");
  for (const auto& one : comparison.channels) {
    if (one.samples == 0) {
      std::printf("%-*s  %12s  %12s  %9s  %8d  %s\n", w, one.channel.c_str(), "-", "-", "-", 0,
                  one.unit.c_str());
      continue;
    }
    std::printf("%-*s  %12.5g  %12.5g  %9.3f  %8d  %s\n", w, one.channel.c_str(), one.rms,
                one.largest, one.at, one.samples, one.unit.c_str());
  }
}

void draw_lines(SvgFigure::Panel& panel, const std::string& label, const Series& a, const Series& b,
                double scale, int colour) {
  const std::string space = label.empty() ? "" : ", ";
  panel.lines.push_back(series_line("A" + space + label, a, scale));
  panel.lines.push_back(series_line("B" + space + label, b, scale));
  panel.lines[panel.lines.size() - 2].colour = panel.lines.back().colour = colour;
  panel.lines.back().dashed = true;
}

std::string figure_of(const Dataset& a, const Dataset& b, const Comparison& comparison) {
  SvgFigure figure("A: " + a.folder + "; B, dashed: " + b.folder);
  for (const auto& one : comparison.channels) {
    if (one.channel.find('/') == std::string::npos) {
      auto& panel = figure.add_panel("time [s]", one.channel + " from rest [deg]");
      const auto turns_a = turns_of(a, one.channel), turns_b = turns_of(b, one.channel);
      for (int k = 0; k < 3; ++k) {
        draw_lines(panel, std::string("about ") + "xyz"[k], turns_a[k], turns_b[k], kDegrees, k);
      }
    } else {
      auto& panel = figure.add_panel("time [s]", one.channel + " [" + one.unit + "]");
      draw_lines(panel, "", a.series(one.channel), b.series(one.channel), 1.0, 0);
    }
  }
  return figure.render();
}

int compare_recordings(const CLI::App& app, const Arguments& arguments) {
  const Dataset a = recording_of(app, arguments.a), b = recording_of(app, arguments.b);
  Comparison comparison = compare(a, b);
  choose(comparison, arguments);
  print(comparison);
  std::vector<std::string> remarks;
  for (const std::string& one : comparison.only_a) remarks.push_back("only in A: " + one);
  for (const std::string& one : comparison.only_b) remarks.push_back("only in B: " + one);
  if (arguments.channels.empty()) tool::say(app, remarks);
  if (arguments.out.empty()) return tool::kDone;
  write_file_atomically(arguments.out, figure_of(a, b, comparison));
  std::cout << "wrote " << arguments.out << "\n";
  return tool::kDone;
}

}  // namespace
}  // namespace anthrob

int main(int argc, char** argv) {
  using namespace anthrob;
  CLI::App app(
      "Compares two recordings, such as one and its replay: for each channel the rms and the "
      "largest of B minus A at A's samples. Both begin at 0 s.",
      "anthrob_compare");
  Arguments arguments;
  app.add_option("A", arguments.a, "bag or dataset folder")->required();
  app.add_option("B", arguments.b, "bag or dataset folder")->required();
  app.add_option("--out", arguments.out, "draw both, channel by channel, to FILE.svg")
      ->check([](const std::string& file) -> std::string {
        return std::filesystem::path(file).extension() == ".svg" ? ""
                                                                 : file + ": expected FILE.svg";
      });
  app.add_option("--channel", arguments.channels,
                 "only biceps_brachii/force, all of biceps_brachii, or every force; may be "
                 "repeated");
  return tool::run(app, argc, argv, [&] { return compare_recordings(app, arguments); });
}
