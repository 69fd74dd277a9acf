#include "output/pose_table.h"

#include <cstdio>

namespace anthrob {
namespace mocap {

namespace {

void append(std::string& line, double value) {
  char text[32];
  std::snprintf(text, sizeof(text), ",%.12g", value);
  line += text;
}

void append(std::string& line, const Quat& q) {
  for (const double value : {q.w(), q.x(), q.y(), q.z()}) append(line, value);
}

}  // namespace

PoseTable::PoseTable(std::ostream& out, const TargetSet& set) : out_(out) {
  out_ << "t";
  for (const MarkerTarget& target : set.targets) {
    for (const char* column : {"valid", "x", "y", "z", "qw", "qx", "qy", "qz", "rms"}) {
      out_ << "," << target.name << "/" << column;
    }
  }
  for (const BallJoint& joint : set.joints) {
    for (const char* column : {"valid", "w", "x", "y", "z"}) {
      out_ << "," << joint.name << "/" << column;
    }
  }
  out_ << "\n";
}

void PoseTable::add(const StereoFrame& frame) {
  char time[32];
  std::snprintf(time, sizeof(time), "%.17g", frame.t);
  std::string line = time;
  for (const TargetPose& pose : frame.targets) {
    if (!pose.valid) {
      line += ",0,,,,,,,,";
      continue;
    }
    line += ",1";
    for (int i = 0; i < 3; ++i) append(line, pose.X.p[i]);
    append(line, canonical(Quat(pose.X.R)));
    append(line, pose.rms);
  }
  for (const JointEstimate& joint : frame.joints) {
    if (!joint.valid) {
      line += ",0,,,,";
      continue;
    }
    line += ",1";
    append(line, joint.q);
  }
  out_ << line << "\n";
}

}  // namespace mocap
}  // namespace anthrob
