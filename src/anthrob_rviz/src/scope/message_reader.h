#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scope/message_definition.h"
#include "scope/quantity.h"
#include "scope/samples.h"

namespace anthrob {

/// Which numbers a message carries.
struct MessageContents {
  std::vector<Quantity> quantities;
  /// Lists that are too long to be offered: "/camera/image/data (921600 entries)".
  std::vector<std::string> left_out;
};

/// The numbers of one message.
struct MessageNumbers {
  std::optional<Nanoseconds> stamp;  ///< of its header, if it has one that is set
  std::vector<double> values;        ///< one for each of contents->quantities
  std::shared_ptr<const MessageContents> contents;
};

/// Takes messages of a topic apart, whatever their type. Words are no numbers, but a list of words
/// beside a list of as many numbers names them. Every length is checked against the bytes that are
/// left before anything is done with it.
class MessageReader {
 public:
  MessageReader(std::string topic, MessageDefinition definition);

  /// None of a message that is shorter or longer than its definition says.
  std::optional<MessageNumbers> read(const std::uint8_t* data, std::size_t size);

 private:
  std::string topic_;
  MessageDefinition definition_;
  /// By what decides about them, all lengths and names. Several publishers may send in turn.
  std::map<std::string, std::shared_ptr<const MessageContents>> known_;
};

}  // namespace anthrob
