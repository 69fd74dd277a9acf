#include "readers.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include "anthrob_calib/resume/result_file.h"
#include "anthrob_core/errors.h"
#include "anthrob_recording/dataset.h"
#include "anthrob_sim/model/robot_model.h"
#include "calibration/calibration_config.h"
#include "camera/camera_model.h"
#include "foreign/foreign_csv.h"
#include "optimiser/journal.h"
#include "path/mesh_file.h"
#include "ros2/cdr_reader.h"
#include "ros2/ros2_messages.h"
#include "source/image_file.h"

namespace anthrob {
namespace fuzz {

namespace {

namespace fs = std::filesystem;

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(in), {});
  if (text.empty()) throw std::runtime_error(file.string() + ": expected a file");
  return text;
}

void write(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

const char kBinaryTriangle[] =
    "binary, 80 characters of text, and after them the number of triangles          \0"
    "\1\0\0\0"
    "\0\0\0\0\0\0\0\0\0\0\x80\x3f"
    "\0\0\0\0\0\0\0\0\0\0\0\0"
    "\xcd\xcc\xcc\x3d\0\0\0\0\0\0\0\0"
    "\0\0\0\0\xcd\xcc\xcc\x3d\0\0\0\0\0";

const char kTetrahedronStl[] =
    "solid t\n"
    "facet normal 0 0 -1\n outer loop\n  vertex 0 0 0\n  vertex 0 0.1 0\n  vertex 0.1 0 0\n "
    "endloop\nendfacet\n"
    "facet normal 0 -1 0\n outer loop\n  vertex 0 0 0\n  vertex 0.1 0 0\n  vertex 0 0 0.1\n "
    "endloop\nendfacet\n"
    "facet normal -1 0 0\n outer loop\n  vertex 0 0 0\n  vertex 0 0 0.1\n  vertex 0 0.1 0\n "
    "endloop\nendfacet\n"
    "facet normal 1 1 1\n outer loop\n  vertex 0.1 0 0\n  vertex 0 0.1 0\n  vertex 0 0 0.1\n "
    "endloop\nendfacet\n"
    "endsolid t\n";

const char kTetrahedronObj[] =
    "v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nv 0 0 0.1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

const char kTetrahedronDae[] =
    "<?xml version=\"1.0\"?>\n"
    "<COLLADA xmlns=\"http://www.collada.org/2005/11/COLLADASchema\" version=\"1.4.1\">\n"
    "<asset><unit name=\"meter\" meter=\"1\"/><up_axis>Z_UP</up_axis></asset>\n"
    "<library_geometries><geometry id=\"g\"><mesh>\n"
    "<source id=\"p\"><float_array id=\"a\" count=\"12\">0 0 0 0.1 0 0 0 0.1 0 0 0 "
    "0.1</float_array>\n"
    "<technique_common><accessor source=\"#a\" count=\"4\" stride=\"3\"><param name=\"X\" "
    "type=\"float\"/>"
    "<param name=\"Y\" type=\"float\"/><param name=\"Z\" "
    "type=\"float\"/></accessor></technique_common></source>\n"
    "<vertices id=\"v\"><input semantic=\"POSITION\" source=\"#p\"/></vertices>\n"
    "<triangles count=\"4\"><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>"
    "<p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles>\n"
    "</mesh></geometry></library_geometries>\n"
    "<library_visual_scenes><visual_scene id=\"s\"><node id=\"n\"><instance_geometry "
    "url=\"#g\"/></node>"
    "</visual_scene></library_visual_scenes>\n"
    "<scene><instance_visual_scene url=\"#s\"/></scene></COLLADA>\n";

const char kMuscles[] =
    "t,stamp,flexor/mode,flexor/reference,flexor/position,flexor/force,flexor/ecu_state\n"
    "0.000000000,0.000000000,POSITION,1.0,0.98,12.5,ENABLED\n"
    "0.010000000,0.010000000,POSITION,1.0,0.99,12.75,ENABLED\n"
    "0.020000000,0.020000000,FORCE,10,0.995,,ENABLED\n";
const char kJoints[] = "t,elbow/position,elbow/velocity\n0,0.5,0\n0.01,0.51,1\n0.02,0.52,1\n";
const char kMeta[] = "robot: two_muscle_rig\nmodel: I\nkind: trajectory\nrate: 100.0\nseed: 1\n";

const char kForeignMap[] =
    "time: {column: time, scale: 0.001}\nrobot: two_muscle_rig\nseparator: ';'\ncolumns:\n"
    "  - {from: angle, to: elbow/position, scale: 0.0174532925}\n"
    "  - {from: pull, to: flexor/force, scale: 9.81}\n"
    "  - {from: {derivative: {clip: angle, low: 0}, over: 0.06}, to: elbow/velocity}\n"
    "split: {train: [0, 0.025]}\n";
const char kForeignTable[] = "time;angle;pull\n0;10.5;1\n10;11.5;2\n20;12.5;\n30;13;3\n";

/// JointState of ROS 2: 5.5 s, frame "", of "elbow" the position 0.5, no velocity, the effort -2.
const char kJointState[] =
    "\0\1\0\0"
    "\5\0\0\0"
    "\0\x65\xcd\x1d"
    "\1\0\0\0"
    "\0\0\0\0"
    "\1\0\0\0"
    "\6\0\0\0"
    "elbow\0"
    "\0\0"
    "\1\0\0\0"
    "\0\0\0\0"
    "\0\0\0\0\0\0\xe0\x3f"
    "\0\0\0\0"
    "\1\0\0\0"
    "\0\0\0\0\0\0\0\xc0";

const char kCamera[] =
    "image_width: 648\nimage_height: 488\ncamera_name: left\n"
    "camera_matrix: {rows: 3, cols: 3, data: [800.0, 0.0, 320.0, 0.0, 800.0, 240.0, 0.0, 0.0, "
    "1.0]}\n"
    "distortion_model: plumb_bob\n"
    "distortion_coefficients: {rows: 1, cols: 5, data: [-0.1, 0.05, 0.0, 0.0, 0.0]}\n"
    "rectification_matrix: {rows: 3, cols: 3, data: [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, "
    "1.0]}\n"
    "projection_matrix: {rows: 3, cols: 4, data: [800.0, 0.0, 320.0, 0.0, 0.0, 800.0, 240.0, 0.0, "
    "0.0, 0.0, 1.0, 0.0]}\n";

/// Sums, without a robot.
class Sums final : public calibration::Evaluator {
 public:
  std::vector<double> fitness(const std::vector<calibration::Point>& points) override {
    std::vector<double> sums;
    for (const calibration::Point& point : points) sums.push_back(point.front());
    return sums;
  }
  std::vector<std::vector<double>> residuals(
      const std::vector<calibration::Point>& points) override {
    return std::vector<std::vector<double>>(points.size(), {1.0, 2.0});
  }
};

void search(const std::string& file, bool resume) {
  Sums sums;
  calibration::Journal::Options options;
  options.file = file;
  options.fingerprint = "0123456789abcdef";
  options.resume = resume;
  calibration::Journal journal(sums, options);
  journal.fitness({{1.0}, {2.0}, {3.0}});
  if (!resume) journal.save();
}

void store(const std::string& file) {
  resume::ResultFile<double> results(file, 17);
  results.append(1, Eigen::VectorXd::LinSpaced(4, 0.0, 1.0));
  results.append(2, Eigen::VectorXd::Zero(3));
}

mocap::Image picture() {
  mocap::Image image;
  image.resize(9, 7);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = static_cast<std::uint8_t>(7 * i);
  return image;
}

}  // namespace

std::vector<Reader> all_readers(const std::string& config, const std::string& work) {
  const fs::path rig = fs::path(config) / "two_muscle_rig";
  const std::string model = content(rig / "model_I.yaml"), urdf = content(rig / "robot.urdf");
  std::vector<Reader> readers;
  const auto add = [&](const std::string& name, const std::string& file,
                       std::vector<std::string> sound,
                       std::function<void(const std::string&)> read) {
    const std::string path = (fs::path(work) / name / file).string();
    fs::create_directories(fs::path(path).parent_path());
    readers.push_back({name, path, std::move(sound), [path, read] { read(path); }});
  };
  const auto beside = [&](const std::string& name, const std::string& file,
                          const std::string& text) { write(fs::path(work) / name / file, text); };
  const auto folder = [](const std::string& file) { return fs::path(file).parent_path().string(); };

  beside("model", "robot.urdf", urdf);
  beside("model", "model_I.yaml", model);
  add("model", "model.yaml", {model, content(rig / "model_hill.yaml")},
      [](const std::string& file) { load_robot_model(file); });
  beside("urdf", "model.yaml", model);
  add("urdf", "robot.urdf", {urdf},
      [=](const std::string& file) { load_robot_model(folder(file) + "/model.yaml"); });

  add("stl", "mesh.stl", {kTetrahedronStl, std::string(kBinaryTriangle, sizeof(kBinaryTriangle))},
      [](const std::string& file) { read_mesh(file); });
  add("obj", "mesh.obj", {kTetrahedronObj}, [](const std::string& file) { read_mesh(file); });
  add("collada", "mesh.dae", {kTetrahedronDae}, [](const std::string& file) { read_mesh(file); });

  for (const char* name : {"table", "meta"}) {
    beside(name, "muscles.csv", kMuscles);
    beside(name, "joints.csv", kJoints);
    beside(name, "meta.yaml", kMeta);
  }
  add("table", "muscles.csv", {kMuscles},
      [=](const std::string& file) { Dataset::load(folder(file)); });
  add("meta", "meta.yaml", {kMeta}, [=](const std::string& file) { Dataset::load(folder(file)); });
  beside("foreign", "map.yaml", kForeignMap);
  add("foreign", "table.csv", {kForeignTable}, [=](const std::string& file) {
    read_foreign_csv(file, ForeignColumns::load(folder(file) + "/map.yaml"));
  });
  beside("map", "table.csv", kForeignTable);
  add("map", "map.yaml", {kForeignMap}, [=](const std::string& file) {
    read_foreign_csv(folder(file) + "/table.csv", ForeignColumns::load(file));
  });

  add("ros2", "message", {std::string(kJointState, sizeof(kJointState) - 1)},
      [](const std::string& file) {
        const std::string bytes = content(file);
        try {
          read_ros2_message("joint_states", bytes.data(), bytes.size());
        } catch (const CdrError& error) {
          throw BadInput(error.what());
        }
      });

  add("camera", "left.yaml", {kCamera},
      [](const std::string& file) { mocap::CameraModel::load(file); });
  const std::string png = (fs::path(work) / "picture.png").string();
  const std::string pgm = (fs::path(work) / "picture.pgm").string();
  mocap::write_grey_image(png, picture());
  mocap::write_grey_image(pgm, picture());
  add("png", "picture.png", {content(png)},
      [](const std::string& file) { mocap::read_grey_image(file); });
  add("pgm", "picture.pgm", {content(pgm)},
      [](const std::string& file) { mocap::read_any_image(file); });

  const fs::path calibrations = fs::path(config) / "anthrob" / "calibration";
  add("calibration", "calibration.yaml",
      {content(calibrations / "tier1_statics_I.yaml"),
       content(calibrations / "tier2_dynamics_III.yaml")},
      [](const std::string& file) { calibration::CalibrationConfig::load(file); });
  const std::string journal = (fs::path(work) / "sound" / "journal.txt").string();
  fs::create_directories(fs::path(journal).parent_path());
  search(journal, false);
  add("journal", "journal.txt", {content(journal)},
      [](const std::string& file) { search(file, true); });
  const std::string results = (fs::path(work) / "sound" / "results").string();
  fs::remove(results);
  store(results);
  add("results", "results", {content(results)}, [](const std::string& file) {
    // What is damaged counts as not there.
    if (!resume::ResultFile<double>(file, 17).find(2)) throw std::runtime_error("no result 2");
  });
  return readers;
}

}  // namespace fuzz
}  // namespace anthrob
