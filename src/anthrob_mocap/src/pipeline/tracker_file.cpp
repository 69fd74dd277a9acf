#include "pipeline/tracker_file.h"

#include <sstream>

#include "anthrob_core/config_node.h"

namespace anthrob {
namespace mocap {

namespace {

/// With swapped bounds no value would lie between them, and no marker would be seen.
void expect_order(const ConfigNode& node, const std::string& low, double least,
                  const std::string& high, double most) {
  if (least < most) return;
  std::ostringstream text;
  text << low << " " << least << ", " << high << " " << most << ": expected " << low << " < "
       << high;
  node.fail(text.str());
}

}  // namespace

TrackerOptions load_tracker_options(const std::string& path) {
  const ConfigNode file = ConfigNode::load(path);
  TrackerOptions options;
  const auto section = [&](const char* name, auto&& read) {
    if (!file.has(name)) return;
    const ConfigNode node = file.at(name);
    if (!node.is_map()) node.fail_expected("a map");
    read(node);
  };
  const auto number = [](const ConfigNode& node, const char* key, double& value, double lo,
                         double hi, const char* unit) {
    value = node.number_or(key, value, Bounds::between(lo, hi), unit);
  };
  section("segmentation", [&](const ConfigNode& node) {
    SegmentationOptions& o = options.segmentation;
    if (node.has("threshold")) o.threshold = node.at("threshold").as_integer(1, 254);
    number(node, "noise_factor", o.noise_factor, 1.0, 1000.0, "1");
    if (node.has("least_threshold"))
      o.least_threshold = node.at("least_threshold").as_integer(1, 254);
    if (node.has("most_threshold")) o.most_threshold = node.at("most_threshold").as_integer(1, 254);
    expect_order(node, "least_threshold", o.least_threshold, "most_threshold", o.most_threshold);
    number(node, "min_area", o.min_area, 1.0, 1e6, "pixel");
    number(node, "max_area", o.max_area, 1.0, 1e6, "pixel");
    expect_order(node, "min_area", o.min_area, "max_area", o.max_area);
    number(node, "max_axis_ratio", o.max_axis_ratio, 1.0, 100.0, "1");
    number(node, "min_fill", o.min_fill, 0.0, 1.0, "1");
    number(node, "least_shape_area", o.least_shape_area, 0.0, 1e6, "pixel");
  });
  section("matching", [&](const ConfigNode& node) {
    MatchingOptions& o = options.matching;
    number(node, "epipolar_tolerance", o.epipolar_tolerance, 0.01, 100.0, "pixel");
    number(node, "min_depth", o.min_depth, 0.01, 100.0, "m");
    number(node, "max_depth", o.max_depth, 0.01, 1000.0, "m");
    expect_order(node, "min_depth", o.min_depth, "max_depth", o.max_depth);
    number(node, "size_factor", o.size_factor, 1.0, 100.0, "1");
  });
  section("labelling", [&](const ConfigNode& node) {
    LabellingOptions& o = options.labelling;
    number(node, "edge_tolerance", o.edge_tolerance, 1e-5, 0.1, "m");
    number(node, "rms_tolerance", o.rms_tolerance, 1e-5, 0.1, "m");
    number(node, "triple_tolerance", o.triple_tolerance, 1e-5, 0.1, "m");
    number(node, "tie_margin", o.tie_margin, 0.0, 0.1, "m");
    if (node.has("step_limit")) o.step_limit = node.at("step_limit").as_integer(100, 100000000);
  });
  section("motion", [&](const ConfigNode& node) {
    MotionOptions& o = options.motion;
    number(node, "max_turn_rate", o.max_turn_rate, 0.01, 1000.0, "rad/s");
    number(node, "max_speed", o.max_speed, 0.01, 1000.0, "m/s");
    number(node, "memory", o.memory, 0.0, 10.0, "s");
  });
  section("pose", [&](const ConfigNode& node) {
    PoseOptions& o = options.pose;
    number(node, "pixel_noise", o.pixel_noise, 1e-4, 10.0, "pixel");
    number(node, "max_turn_sigma", o.max_turn_sigma, 1e-5, 1.0, "rad");
  });
  if (file.has("most_points")) options.most_points = file.at("most_points").as_integer(3, 10000);
  file.refuse_unknown_keys();
  file.refuse_empty_values();
  return options;
}

}  // namespace mocap
}  // namespace anthrob
