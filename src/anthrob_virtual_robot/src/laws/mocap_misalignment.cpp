#include "laws/laws.h"

namespace anthrob::virtual_robot {
namespace {

class TurnedFrame final : public ReadingLaw {
 public:
  explicit TurnedFrame(const Eigen::Quaterniond& turn) : turn_(turn) {}
  void apply(Readings* readings) override {
    readings->shoulder = turn_ * readings->shoulder;
    if (readings->shoulder.w() < 0.0) readings->shoulder.coeffs() *= -1.0;
  }

 private:
  Eigen::Quaterniond turn_;  // in the axes of the humerus at rest
};

}  // namespace

HiddenLaw mocap_misalignment() {
  HiddenLaw law;
  law.id = "mocap_misalignment";
  law.law = "as in the catalogue";
  law.sizes = {"angle"};
  law.places = world_axes;
  law.draw = [](const auto&, const auto&, Random* random) -> Parameters {
    return {{"angle", 0.03 * random->sign()}};
  };
  law.build = [](const Hidden& h, Draft* draft) {
    if (h["angle"] == 0.0) return;
    const Eigen::Vector3d axis_W = Eigen::Vector3d::Unit(h.place[0] - 'x');
    const Eigen::Vector3d axis = draft->arm.skeleton.X_WH_rest.linear().transpose() * axis_W;
    draft->reading_laws.push_back(
        std::make_shared<TurnedFrame>(Eigen::Quaterniond(Eigen::AngleAxisd(h["angle"], axis))));
  };
  return law;
}

}  // namespace anthrob::virtual_robot
