#include "separation/separating_experiment.h"

#include <algorithm>
#include <set>
#include <vector>

namespace anthrob {
namespace discovery {

namespace {

/// Any two of `effects` are told apart by `recording`. The first entry that has both is used.
struct Separation {
  std::set<std::string> effects;
  const char* recording;
};

const std::vector<Separation>& separations() {
  static const std::vector<Separation> list = {
      {{"joint_offset_torque", "joint_coulomb_asymmetric", "joint_coulomb"},
       "with the drive off, push the joint out of rest to both sides, then do the same with the "
       "joint turned upside down: the offset of an amplifier vanishes and a weight acts the other "
       "way, friction stays the same (with the drive on, all of them are the same torque, at rest "
       "and in motion)"},
      {{"eyelet_friction", "wrap_friction", "joint_coulomb", "ball_joint_load_friction",
        "joint_coulomb_asymmetric"},
       "repeat one motion at three levels of co-contraction: dry joint friction stays the same, "
       "friction of tendons and of loaded joints grows; then do so at a second posture"},
      {{"joint_lugre", "joint_presliding"},
       "turn at constant speeds from the slowest that the drive can do upwards, each twice that of "
       "the one before: friction that breaks away is largest at the slowest"},
      {{"joint_presliding", "joint_lugre", "joint_coulomb", "joint_coulomb_asymmetric"},
       "move the joint to and fro by ever smaller strokes, down to a tenth of a degree or of a "
       "millimetre, slowly: what bends gives back, what only rubs does not"},
      {{"joint_quadratic_drag", "joint_viscous", "joint_coulomb"},
       "turn at five constant speeds, 1 : 2 : 4 : 8 : 16, in both directions, and compare the "
       "efforts that it takes"},
      {{"effort_gain", "joint_effort_friction", "joint_coulomb", "joint_viscous", "payload"},
       "let a known weight pull at the joint, and move it up and down slowly: a wrong gain is the "
       "same both ways, friction is not; then repeat this with twice the weight"},
      {{"joint_load_friction", "joint_coulomb", "joint_coulomb_asymmetric"},
       "repeat one slow motion with a known mass added to the joint: only friction that goes with "
       "the load grows"},
      {{"joint_ripple", "joint_coulomb", "joint_offset_torque", "cable_drag"},
       "move slowly over the whole range, to and fro: what depends on the position comes back at "
       "the same places, in both directions"},
      {{"eyelet_presliding", "joint_coulomb", "pwm_dead_zone", "eyelet_friction"},
       "stop after motion from either side and wait, then make tiny reversals of less than a "
       "millimetre of tendon"},
      {{"motor_friction", "pwm_dead_zone", "series_resistance", "gear_efficiency"},
       "run the motor at five constant voltages with no load, then with a known one: friction "
       "takes the same current at all, a dead zone the same voltage, a resistance a voltage in "
       "proportion to the current, a gear a share of the load"},
      {{"motor_friction", "joint_coulomb", "eyelet_friction"},
       "uncouple the motor and compare the current that it takes at constant speed with the one "
       "that it takes with joint or tendon"},
      {{"gear_efficiency", "eyelet_friction", "series_resistance"},
       "lock the spindle and compare motor current with tendon force"},
      {{"gear_backlash", "eyelet_presliding", "tendon_elasticity"},
       "reverse the motor without and with high pretension: backlash vanishes under pretension"},
      {{"spindle_growth", "tendon_elasticity"},
       "record the same force at two angles of the spindle, and the same angle at two forces"},
      {{"tendon_creep", "second_maxwell_arm", "encoder_drift"},
       "hold the length for two minutes, hold the force for two minutes, then return to the stop"},
      {{"second_maxwell_arm", "see_hysteresis"},
       "stretch and release the spring at three rates, 1 : 10 : 100"},
      {{"see_mullins", "second_maxwell_arm", "see_hysteresis"},
       "stretch and release the spring, then repeat this after ten minutes of rest"},
      {{"see_stiffening", "see_toe", "force_sensor_gain"},
       "stretch the spring slowly from rest as far as it may go: a toe ends, a modulus that "
       "depends on strain goes on to change, a gain is the same at all forces"},
      {{"see_toe", "force_sensor_offset", "force_sensor_gain"},
       "read the force sensor with the tendon unloaded"},
      {{"series_resistance", "supply_sag", "winding_heating"},
       "run one motor cold, then all motors at once, then one motor after ten minutes at stall"},
      {{"payload", "gravity_tilt", "cable_drag", "via_point_shift"},
       "record postures at rest over the whole range, with the base tilted by a known angle and "
       "with a known mass added to the hand"},
      {{"command_latency", "sensing_latency", "mocap_delay"},
       "drive one motor with a chirp while its tendon is slack, and compare encoder and motion "
       "capture with the command"},
  };
  return list;
}

}  // namespace

std::string separating_experiment(const std::string& id, const std::string& rival) {
  if (id == rival) {
    return "move the muscles or joints in question one at a time while the others are held: the "
           "right place is the one whose motion still disagrees";
  }
  for (const Separation& separation : separations()) {
    if (separation.effects.count(id) && separation.effects.count(rival)) {
      return separation.recording;
    }
  }
  return "record slow and fast motion over the whole range at two levels of co-contraction, with "
         "rests after motion from either side";
}

}  // namespace discovery
}  // namespace anthrob
