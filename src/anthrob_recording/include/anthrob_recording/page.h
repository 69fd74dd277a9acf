#pragma once

#include <set>
#include <string>
#include <vector>

#include "anthrob_core/files.h"

namespace anthrob {

/// Makes the page of a report: the program anthrob_page fills in templates/NAME.html.j2 of a
/// package with what was written to `data`. The report is complete without it, so this comes last.
/// @param data JSON of the report; its figures lie beside it
/// @param page file to write. If that fails, an earlier page is removed: it would not belong to the
/// data
/// @throws std::runtime_error with one line: the page, and why it could not be made
void write_page(const std::string& name, const std::string& data, const std::string& page);

/// Names of the figures among a report's files, for `figures` in its JSON: the page shows these only.
std::vector<std::string> figures_of(const OutputFiles& files);

/// Removes figures of an earlier report, figures/KIND.svg and figures/KIND_2.svg, from its folder;
/// to be called once the new one is written.
/// @param kinds of figures that such a report may have
/// @param files of the new report, which stay
void remove_other_figures(const std::string& folder, const std::set<std::string>& kinds,
                          const OutputFiles& files);

}  // namespace anthrob
