#include "anthrob_calib/discovery/separating_experiment.h"

#include <algorithm>
#include <set>
#include <vector>

namespace anthrob {
namespace discovery {

namespace {

/// Any two of these are told apart by the same recording. The first that has both counts.
struct Separation {
  std::set<std::string> effects;
  const char* recording;
};

const std::vector<Separation>& separations() {
  static const std::vector<Separation> list = {
      {{"joint_offset_torque", "joint_coulomb_asymmetric", "joint_coulomb"},
       "push the joint out of rest to both sides with the drive off, and once more with the joint "
       "turned over: an offset of the amplifier or a weight goes or turns, friction stays; with "
       "the "
       "drive on they are the same torque, in motion and at rest"},
      {{"eyelet_friction", "wrap_friction", "joint_coulomb", "ball_joint_load_friction",
        "joint_coulomb_asymmetric"},
       "the same motion at three levels of co-contraction: dry joint friction stays as it is, "
       "friction of tendons and of loaded joints grows; then the same at a second posture"},
      {{"eyelet_presliding", "joint_coulomb", "pwm_dead_zone", "eyelet_friction"},
       "stop after motion from both sides and wait, then tiny reversals of less than a millimetre "
       "of tendon"},
      {{"gear_efficiency", "eyelet_friction", "series_resistance"},
       "lock the spindle and compare motor current with tendon force"},
      {{"gear_backlash", "eyelet_presliding", "tendon_elasticity"},
       "reverse the motor at no and at high pretension: backlash vanishes under pretension"},
      {{"spindle_growth", "tendon_elasticity"},
       "the same force at two windings, and the same winding at two forces"},
      {{"tendon_creep", "second_maxwell_arm", "encoder_drift"},
       "hold the length for two minutes, hold the force for two minutes, then return to the stop"},
      {{"second_maxwell_arm", "see_hysteresis"},
       "one stretching loop at three rates, 1 : 10 : 100"},
      {{"see_mullins", "second_maxwell_arm", "see_hysteresis"},
       "repeat the first loop after ten minutes of rest"},
      {{"see_toe", "force_sensor_offset", "force_sensor_gain"},
       "read the force sensor with the tendon unloaded"},
      {{"series_resistance", "supply_sag", "winding_heating"},
       "one motor cold, all motors at once, one motor after ten minutes at stall"},
      {{"payload", "gravity_tilt", "cable_drag", "via_point_shift"},
       "rest postures over the whole range with the base tilted by a known angle and with a known "
       "mass added to the hand"},
      {{"command_latency", "sensing_latency", "mocap_delay"},
       "a chirp of one motor, tendon slack: encoder and motion capture against the command"},
  };
  return list;
}

}  // namespace

std::string separating_experiment(const std::string& id, const std::string& rival) {
  if (id == rival) {
    return "move the muscles or joints in question one at a time, the others held: the place shows "
           "where the disagreement stays";
  }
  for (const Separation& separation : separations()) {
    if (separation.effects.count(id) && separation.effects.count(rival)) {
      return separation.recording;
    }
  }
  return "slow and fast motion over the whole range at two levels of co-contraction, with rests "
         "after motion from both sides";
}

}  // namespace discovery
}  // namespace anthrob
