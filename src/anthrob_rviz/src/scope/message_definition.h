#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace anthrob {

/// One field of a message type.
struct MessageField {
  enum class Kind {
    kBool,
    kInt8,
    kUint8,
    kInt16,
    kUint16,
    kInt32,
    kUint32,
    kInt64,
    kUint64,
    kFloat32,
    kFloat64,
    kTime,
    kDuration,
    kString,
    kMessage
  };
  enum class Array { kNone, kFixed, kVariable };

  std::string name;
  Kind kind = Kind::kFloat64;
  std::size_t message = 0;  ///< place in MessageDefinition::messages, of a kMessage
  Array array = Array::kNone;
  std::uint32_t count = 1;          ///< of a kFixed one
  std::optional<std::string> unit;  ///< the only one that its comment gives: "[rad/s]"
};

/// The fields of one message type, in the order in which they are sent.
struct MessageFields {
  std::string type;  ///< "geometry_msgs/Vector3"
  std::vector<MessageField> fields;
  std::uint64_t least_size = 0;  ///< [bytes] with all lists empty; 0: it never has any
  bool named = false;            ///< has a list of words, which may name the entries of others
  bool is_quaternion = false;
};

/// A message type with all types that it contains, as publishers and bags send it along.
struct MessageDefinition {
  std::vector<MessageFields> messages;  ///< the first one is the message itself
};

/// [bytes] of one entry; none of a string or a message
std::optional<std::uint32_t> size_of(MessageField::Kind kind);

/// @param type "anthrob_msgs/MuscleStates"
/// @param text its definition, and below lines of "=" those of the types that it contains
/// @throws BadInput naming type and line. What it returns is finite: no type contains itself.
MessageDefinition parse_definition(const std::string& type, const std::string& text);

}  // namespace anthrob
