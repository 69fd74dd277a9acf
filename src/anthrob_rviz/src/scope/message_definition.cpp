#include "scope/message_definition.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <limits>
#include <map>
#include <sstream>
#include <utility>

#include "anthrob_core/errors.h"
#include "anthrob_core/text.h"

namespace anthrob {
namespace {

using Kind = MessageField::Kind;

constexpr std::uint32_t kListSize = 4;    // [bytes] of the number of entries that precedes them
constexpr std::size_t kMostTypes = 1000;  // the largest in use have some 30
constexpr std::size_t kMostNesting = 30;
// Beyond any message; keeps sums of sizes within 64 bits.
constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 40;

std::optional<Kind> kind_of(const std::string& word) {
  static const std::map<std::string, Kind> kKinds = {
      {"bool", Kind::kBool},       {"int8", Kind::kInt8},     {"byte", Kind::kInt8},
      {"uint8", Kind::kUint8},     {"char", Kind::kUint8},    {"int16", Kind::kInt16},
      {"uint16", Kind::kUint16},   {"int32", Kind::kInt32},   {"uint32", Kind::kUint32},
      {"int64", Kind::kInt64},     {"uint64", Kind::kUint64}, {"float32", Kind::kFloat32},
      {"float64", Kind::kFloat64}, {"time", Kind::kTime},     {"duration", Kind::kDuration},
      {"string", Kind::kString}};
  const auto found = kKinds.find(word);
  if (found == kKinds.end()) return std::nullopt;
  return found->second;
}

bool is_unit(const std::string& text) {
  const auto fits = [](unsigned char c) {
    return std::isalnum(c) || c == '/' || c == '^' || c == '*';
  };
  return !text.empty() && std::isalpha(static_cast<unsigned char>(text[0])) &&
         std::all_of(text.begin(), text.end(), fits);
}

/// None of two or more: which would be whose?
std::optional<std::string> unit_in(const std::string& comment) {
  std::optional<std::string> unit;
  for (std::size_t at = comment.find('['); at != std::string::npos;
       at = comment.find('[', at + 1)) {
    const std::size_t end = comment.find(']', at);
    if (end == std::string::npos) break;
    const std::string text = comment.substr(at + 1, end - at - 1);
    if (!is_unit(text)) continue;
    if (unit) return std::nullopt;
    unit = text;
  }
  return unit;
}

/// One line that declares a field, taken apart.
struct Declaration {
  std::string type, array, name, comment;
};

/// None of an empty line, a comment or a constant.
std::optional<Declaration> declaration_in(const std::string& line) {
  const std::string text = trimmed(line);
  if (text.empty() || text[0] == '#') return std::nullopt;
  const auto expect = [&](bool true_here) {
    if (!true_here) throw BadInput("'" + text.substr(0, 80) + "'; expected TYPE NAME");
  };
  Declaration result;
  const std::size_t blank = text.find_first_of(" \t");
  expect(blank != std::string::npos);
  result.type = text.substr(0, blank);
  const std::string rest = trimmed(text.substr(blank));
  std::size_t end = 0;
  while (end < rest.size() &&
         (std::isalnum(static_cast<unsigned char>(rest[end])) || rest[end] == '_'))
    ++end;
  result.name = rest.substr(0, end);
  const std::string tail = trimmed(rest.substr(end));
  expect(!result.name.empty());
  if (!tail.empty() && tail[0] == '=') return std::nullopt;
  expect(tail.empty() || tail[0] == '#');
  result.comment = tail;
  const std::size_t bracket = result.type.find('[');
  if (bracket != std::string::npos) {
    result.array = result.type.substr(bracket);
    result.type.resize(bracket);
    expect(result.array.back() == ']');
  }
  return result;
}

void set_array(const Declaration& declared, MessageField& field) {
  if (declared.array.empty()) return;
  if (declared.array == "[]") {
    field.array = MessageField::Array::kVariable;
    return;
  }
  const std::string digits = declared.array.substr(1, declared.array.size() - 2);
  const bool number =
      !digits.empty() && digits.size() <= 9 &&
      std::all_of(digits.begin(), digits.end(), [](unsigned char c) { return std::isdigit(c); });
  if (!number) throw BadInput("'" + declared.array + "'; expected a number of entries");
  field.array = MessageField::Array::kFixed;
  field.count = static_cast<std::uint32_t>(std::strtoul(digits.c_str(), nullptr, 10));
}

/// Builds the list of types: first all names, then their fields, then their sizes.
class DefinitionParser {
 public:
  DefinitionParser(const std::string& type, const std::string& text) {
    split(type, text);
    for (std::size_t i = 0; i < bodies_.size(); ++i) parse(i);
    states_.resize(bodies_.size(), State::kNew);
    measure(0, 0);
  }
  MessageDefinition take() { return std::move(definition_); }

 private:
  enum class State { kNew, kOpen, kDone };

  void begin_type(const std::string& type) {
    if (bodies_.size() == kMostTypes)
      throw BadInput(type + ": more than 1000 types in one definition");
    places_.emplace(type, bodies_.size());
    bodies_.emplace_back();
    definition_.messages.emplace_back();
    definition_.messages.back().type = type;
  }

  void split(const std::string& type, const std::string& text) {
    begin_type(type);
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
      const std::string plain = trimmed(line);
      if (plain.rfind("MSG:", 0) == 0) {
        begin_type(trimmed(plain.substr(4)));
      } else if (plain.find_first_not_of('=') != std::string::npos) {
        bodies_.back().push_back(line);
      }
    }
  }

  void parse(std::size_t index) {
    MessageFields& message = definition_.messages[index];
    for (const std::string& line : bodies_[index]) {
      try {
        const auto declared = declaration_in(line);
        if (declared) message.fields.push_back(field_of(*declared, message.type));
      } catch (const BadInput& error) {
        throw BadInput("definition of " + message.type + ": " + error.what());
      }
    }
    for (const MessageField& field : message.fields) {
      message.named = message.named ||
                      (field.kind == Kind::kString && field.array != MessageField::Array::kNone);
    }
    const auto is = [&](std::size_t i, const char* name) {
      const MessageField& field = message.fields[i];
      return field.name == name && field.kind == Kind::kFloat64 &&
             field.array == MessageField::Array::kNone;
    };
    message.is_quaternion =
        message.fields.size() == 4 && is(0, "x") && is(1, "y") && is(2, "z") && is(3, "w");
  }

  MessageField field_of(const Declaration& declared, const std::string& parent) const {
    MessageField field;
    field.name = declared.name;
    field.unit = unit_in(declared.comment);
    set_array(declared, field);
    if (const auto kind = kind_of(declared.type)) {
      field.kind = *kind;
      return field;
    }
    field.kind = Kind::kMessage;
    field.message = place_of_type(declared.type, parent);
    return field;
  }

  /// As genmsg does it: without a package it is of the same one, but for Header.
  std::size_t place_of_type(const std::string& type, const std::string& parent) const {
    const std::string package = parent.substr(0, parent.find('/') + 1);
    const bool whole = type.find('/') != std::string::npos;
    const std::string names[] = {whole ? type : package + type,
                                 type == "Header" ? "std_msgs/Header" : type};
    for (const std::string& name : names) {
      const auto found = places_.find(name);
      if (found != places_.end()) return found->second;
    }
    throw BadInput("the type " + type + " is not defined");
  }

  std::uint64_t measure(std::size_t index, std::size_t depth) {
    MessageFields& message = definition_.messages[index];
    if (states_[index] == State::kDone) return message.least_size;
    if (states_[index] == State::kOpen)
      throw BadInput("definition of " + message.type + ": it contains itself");
    if (depth > kMostNesting)
      throw BadInput("definition of " + message.type + ": nested too deeply");
    states_[index] = State::kOpen;
    std::uint64_t sum = 0;
    for (const MessageField& field : message.fields) {
      std::uint64_t size = kListSize;
      if (field.array != MessageField::Array::kVariable)
        size = entry_size(field, depth) * field.count;
      else
        entry_size(field, depth);
      sum += std::min(size, kMostBytes);
      if (sum > kMostBytes) sum = kMostBytes;
    }
    message.least_size = sum;
    states_[index] = State::kDone;
    return sum;
  }

  std::uint64_t entry_size(const MessageField& field, std::size_t depth) {
    if (field.kind != Kind::kMessage) return size_of(field.kind).value_or(kListSize);
    // Times a count of nine digits this fits 64 bits.
    return std::min(measure(field.message, depth + 1), std::uint64_t{1} << 33);
  }

  MessageDefinition definition_;
  std::map<std::string, std::size_t> places_;
  std::vector<std::vector<std::string>> bodies_;
  std::vector<State> states_;
};

}  // namespace

std::optional<std::uint32_t> size_of(MessageField::Kind kind) {
  switch (kind) {
    case Kind::kBool:
    case Kind::kInt8:
    case Kind::kUint8:
      return 1;
    case Kind::kInt16:
    case Kind::kUint16:
      return 2;
    case Kind::kInt32:
    case Kind::kUint32:
    case Kind::kFloat32:
      return 4;
    case Kind::kInt64:
    case Kind::kUint64:
    case Kind::kFloat64:
    case Kind::kTime:
    case Kind::kDuration:
      return 8;
    case Kind::kString:
    case Kind::kMessage:
      return std::nullopt;
  }
  return std::nullopt;
}

MessageDefinition parse_definition(const std::string& type, const std::string& text) {
  return DefinitionParser(type, text).take();
}

}  // namespace anthrob
