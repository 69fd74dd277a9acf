#pragma once

#include <anthrob_msgs/Gap.h>
#include <anthrob_msgs/MuscleCommand.h>
#include <anthrob_msgs/MuscleStates.h>
#include <anthrob_msgs/PlayerState.h>
#include <diagnostic_msgs/DiagnosticStatus.h>

#include <optional>
#include <vector>

#include "diagnostics.h"
#include "muscle_reading.h"
#include "muscle_row.h"
#include "player_reading.h"
#include "twin_reading.h"

namespace anthrob {

/// None of a message whose lists have different lengths.
std::optional<MuscleReadings> readings_of(const anthrob_msgs::MuscleStates& message);
PlayerReading reading_of(const anthrob_msgs::PlayerState& message);
/// None of a message whose lists do not fit together.
std::optional<GapReading> reading_of(const anthrob_msgs::Gap& message);
Diagnosis diagnosis_of(const diagnostic_msgs::DiagnosticStatus& status);
/// Without a stamp.
anthrob_msgs::MuscleCommand command_of(const std::vector<Reference>& references);

}  // namespace anthrob
