#pragma once

namespace anthrob {
namespace health {

/// How the tendons are tested, and what counts as a change.
struct HealthOptions {
  // The protocol: 60 s.
  double share_of_force = 0.3;    ///< [1] of the largest force that a muscle may have
  double highest_tension = 50.0;  ///< [N] whatever the muscle may have
  double unbalanced = 0.02;       ///< [Nm] that the tensions of a level may leave at a joint
  double hanging = 0.3;           ///< [Nm] that hold an arm at rest, at most: it is let go
  double slack = 0.3;             ///< [rad] that a motor lets out beyond no tension
  double speed = 1.0;             ///< [rad/s] of a motor on its way to the first reference
  double share_of_level = 1.5;    ///< of the tension that is asked for; beyond it,
  double beside_level = 15.0;     ///< [N] and this, the test ends
  double largest_turn = 0.035;    ///< [rad, 0.1 m] of a joint; beyond it, the test ends

  // Figures.
  double rate = 50.0;           ///< [Hz] of means that are compared
  double beside = 0.25;         ///< [s] to either side, for the velocity of a motor that holds
  double after_step = 1.0;      ///< [s] until the motors stand still at a level
  double after_ramp = 0.7;      ///< [s] until a flank of the reversal, or a hold, counts
  double creep_begin = 1.0;     ///< [s] at the beginning of the hold, and
  double creep_end = 3.0;       ///< [s] at its end, between which the force falls
  double still_block = 0.1;     ///< [s] whose noise is one witness
  int still_blocks = 5;         ///< among which they are dealt out
  double off_reference = 0.02;  ///< [rad] by which a recorded reference may differ
  double fresh = 0.05;          ///< [s] from a sample, at most; else nothing was measured then

  // Trends.
  int first_tests = 3;         ///< that say what is normal
  int many_tests = 9;          ///< from which on their scatter says more than their intervals
  int fewest_tests = 5;        ///< before anything is called a change
  double sure = 5.0;           ///< standard errors of a change
  double few_tests = 8.0;      ///< over their number: by so much larger, as few tell scatter badly
  double least_scatter = 0.2;  ///< of the limit: tests that agree by chance tell no change of less
};

}  // namespace health
}  // namespace anthrob
