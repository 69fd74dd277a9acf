#pragma once

#include <string>

#include "anthrob_core/files.h"
#include "anthrob_sim/model/robot_model.h"
#include "conclusion/answer.h"
#include "question/question.h"

namespace anthrob {
namespace discovery {

/// report.json, for scripts (docs/files.md) and for the page.
/// @param runtime of the search [s]
/// @param figures of the report, which it names
std::string report_json(const Answer& answer, const Question& question, double runtime,
                        const OutputFiles& figures = {});

/// report.json and figures/*.svg: what the page, templates/discovery.html.j2, is made from.
/// @param runtime of the search [s]   @param robot to be drawn; null: not drawn
OutputFiles report_files(const Answer& answer, const Question& question, double runtime,
                         const RobotModel* robot = nullptr);

}  // namespace discovery
}  // namespace anthrob
