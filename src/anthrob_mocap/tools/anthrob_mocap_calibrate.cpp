// Calibrates a stereo rig from pairs of pictures of a checkerboard.
#include <filesystem>
#include <iostream>
#include <map>

#include "anthrob_core/command_line.h"
#include "anthrob_core/errors.h"
#include "anthrob_core/files.h"
#include "calibration/stereo_calibration.h"
#include "source/image_file.h"

namespace mocap = anthrob::mocap;
namespace fs = std::filesystem;

namespace {

struct Arguments {
  std::string left, right, board = "9x6", out = "calibration";
  double square = 0.025;
  mocap::CalibrationLimits limits;
};

/// left07.jpg and right07.jpg belong together.
std::string key_of(const std::string& file) {
  return mocap::image_number(file).value_or(fs::path(file).stem().string());
}

std::map<std::string, std::string> by_key(const std::string& folder) {
  std::map<std::string, std::string> files;
  for (const std::string& file : mocap::list_images(folder)) {
    if (!files.emplace(key_of(file), folder + "/" + file).second) {
      throw anthrob::BadInput(folder + "/" + file +
                              ": another image of this folder has the same number, " +
                              key_of(file));
    }
  }
  return files;
}

/// Both or none: two cameras of two calibrations are no rig.
void write(const std::string& folder, const mocap::StereoRig& rig) {
  const auto file = [&](mocap::Side side) { return folder + "/" + mocap::name(side) + ".yaml"; };
  anthrob::write_files_atomically({{file(mocap::kLeft), rig.camera(mocap::kLeft).to_yaml()},
                                   {file(mocap::kRight), rig.camera(mocap::kRight).to_yaml()}});
  for (const auto side : {mocap::kLeft, mocap::kRight}) {
    std::cout << "written            " << file(side) << "\n";
  }
}

int calibrate(const Arguments& arguments) {
  const auto board = mocap::Board::parse(arguments.board, arguments.square);
  const auto left = by_key(arguments.left), right = by_key(arguments.right);
  for (const auto& [key, file] : right) {
    if (left.count(key) == 0) std::cout << file << ": no partner in " << arguments.left << "\n";
  }
  std::vector<mocap::BoardView> views;
  int width = 0, height = 0;
  for (const auto& [key, file] : left) {
    if (anthrob::tool::interrupted()) return anthrob::tool::kInterrupted;
    const auto partner = right.find(key);
    if (partner == right.end()) {
      std::cout << file << ": no partner in " << arguments.right << "\n";
      continue;
    }
    mocap::BoardView view;
    view.name = key;
    for (const auto side : {mocap::kLeft, mocap::kRight}) {
      const std::string& name = side == mocap::kLeft ? file : partner->second;
      const mocap::Image image = mocap::read_any_image(name);
      if (width == 0) width = image.width, height = image.height;
      if (image.width != width || image.height != height) {
        throw anthrob::BadInput(name + ": " + std::to_string(image.width) + "x" +
                                std::to_string(image.height) + " pixels: expected " +
                                std::to_string(width) + "x" + std::to_string(height) +
                                ", as the other images have");
      }
      const auto corners = mocap::find_corners(image, board);
      if (corners)
        view.corners[side] = *corners;
      else
        std::cout << name << ": no board of " << arguments.board << " corners found\n";
    }
    if (view.corners[mocap::kLeft].empty() || view.corners[mocap::kRight].empty()) continue;
    mocap::same_direction(view.corners[mocap::kLeft], view.corners[mocap::kRight]);
    views.push_back(view);
  }
  const auto result = mocap::calibrate_stereo(views, board, width, height, arguments.limits);
  if (anthrob::tool::interrupted()) return anthrob::tool::kInterrupted;
  std::cout << result.report();
  fs::create_directories(arguments.out);
  write(arguments.out, result.rig);
  return anthrob::tool::kDone;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Calibrates a stereo rig from pairs of pictures of a checkerboard.",
               "anthrob_mocap_calibrate");
  Arguments a;
  app.option_defaults()->always_capture_default();
  app.add_option("--left", a.left, "folder of the left camera's pictures")->required();
  app.add_option("--right", a.right,
                 "the same for the right camera; equal numbers in the names make a pair")
      ->required();
  app.add_option("--board", a.board, "number of inner corners, COLUMNSxROWS");
  app.add_option("--square", a.square, "edge length of a square [m]");
  app.add_option("--out", a.out, "folder for left.yaml and right.yaml");
  app.add_option("--max-rms", a.limits.stereo_rms, "refuse a larger reprojection error [pixel]")
      ->check(anthrob::tool::within(0.01, 100.0));
  app.add_option("--min-coverage", a.limits.least_coverage,
                 "refuse corners that cover a smaller share of the picture, 0 to 1")
      ->check(anthrob::tool::within(0.0, 1.0));
  return anthrob::tool::run(app, argc, argv, [&] { return calibrate(a); });
}
