#pragma once

#include <ros/exception.h>
#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <ros/service_traits.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace anthrob {

/// A message as it came, or why it is none. On the wire it is an M.
///
/// roscpp makes room for as many entries as a list says it has, before it looks whether they came:
/// 56 bytes that claim 33 million names take 1 GB and stop a node for seconds. Here a list that
/// says more than can be in the bytes that are left is refused first.
template <class M>
struct Bounded {
  M message;
  std::optional<std::string> refusal;
};

/// Reads any message, whose generated code passes each of its fields to next().
class BoundedStream final : public ros::serialization::IStream {
 public:
  using IStream::IStream;

  template <class T>
  void next(T& field) {
    ros::serialization::deserialize(*this, field);
  }
  template <class T, class Allocator>
  void next(std::vector<T, Allocator>& list) {
    std::uint32_t count = 0;
    next(count);
    const std::uint32_t left = getLength();
    const std::uint32_t least = std::max(1u, ros::serialization::serializationLength(T()));
    if (count > left / least) {
      throw ros::Exception("a list says that it has " + std::to_string(count) + " entries, and " +
                           std::to_string(left) + " bytes are left");
    }
    list.resize(count);
    for (T& entry : list) next(entry);
  }
};

}  // namespace anthrob

namespace ros {

namespace message_traits {
template <class M>
struct MD5Sum<anthrob::Bounded<M>> : MD5Sum<M> {
  using MD5Sum<M>::value;
  static const char* value(const anthrob::Bounded<M>&) { return MD5Sum<M>::value(); }
};
template <class M>
struct DataType<anthrob::Bounded<M>> : DataType<M> {
  using DataType<M>::value;
  static const char* value(const anthrob::Bounded<M>&) { return DataType<M>::value(); }
};
template <class M>
struct Definition<anthrob::Bounded<M>> : Definition<M> {
  using Definition<M>::value;
  static const char* value(const anthrob::Bounded<M>&) { return Definition<M>::value(); }
};
}  // namespace message_traits

namespace service_traits {
template <class M>
struct MD5Sum<anthrob::Bounded<M>> : MD5Sum<M> {
  using MD5Sum<M>::value;
  static const char* value(const anthrob::Bounded<M>&) { return MD5Sum<M>::value(); }
};
template <class M>
struct DataType<anthrob::Bounded<M>> : DataType<M> {
  using DataType<M>::value;
  static const char* value(const anthrob::Bounded<M>&) { return DataType<M>::value(); }
};
}  // namespace service_traits

namespace serialization {
template <class M>
struct Serializer<anthrob::Bounded<M>> {
  template <class Stream>
  static void read(Stream& stream, anthrob::Bounded<M>& received) {
    anthrob::BoundedStream bounded(stream.getData(), stream.getLength());
    try {
      bounded.next(received.message);
    } catch (const ros::Exception& error) {  // also of a message that ends early
      received.message = M();
      received.refusal = std::string("malformed: ") + error.what();
    }
  }
};
}  // namespace serialization

}  // namespace ros
