#pragma once

#include <string>

#include "conclusion/answer.h"
#include "question/question.h"

namespace anthrob {
namespace discovery {

/// The verdict in one or two sentences of a page.
std::string answer_sentences(const Answer& answer, const Question& question);

/// What the reader can do now, as a list.
std::string next_steps(const Answer& answer, const Question& question);

/// Laws that earned their place and were not added, with what speaks against them; empty: none.
std::string improbable_sentence(const Answer& answer);

/// What speaks against a law: ", with offset_u at the end of its range ..."; empty: nothing.
/// @param at_limit, spoils of the law (FoundEffect)
std::string doubt_clause(const std::string& at_limit, const std::string& spoils);

/// "0.05 Nm", not to be broken between lines; without unit where there is none.
std::string with_unit(double value, const std::string& unit);

}  // namespace discovery
}  // namespace anthrob
