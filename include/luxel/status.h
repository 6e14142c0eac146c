/// \file
/// Status and Result: how every luxel call reports failure. No exceptions, no logging.
#pragma once
#include <string>
#include <utility>
#include <variant>

/// Each kernel has parameters (a struct), validate() and plan(), which gives the passes as data. vulkan::Pipeline,
/// opencl::Pipeline and reference::run carry a plan out; Context is the short way to all three.
namespace luxel {

/// Kinds of failure.
enum class Code {
  ok,
  invalid_argument,  ///< a parameter, size or binding is out of its documented range
  unsupported,       ///< the device lacks a feature, or a limit of it is too small
  missing_driver,    ///< no driver, loader or device of that name on this machine
  compile_failed,    ///< the driver's compiler refused a kernel
  out_of_memory,     ///< host or device memory ran out
  device_lost,       ///< the device stopped answering; make a new one
  io,                ///< a file could not be read or written
  internal           ///< a defect of luxel: please report it
};

/// The name of a code as it is spelled above.
const char* name(Code code);

/// Outcome of a call: a code, and for a failure one line that names the field, its value and the allowed range.
class [[nodiscard]] Status {
 public:
  /// Success.
  Status() = default;
  /// A failure, or with Code::ok success.
  Status(Code code, std::string message) : code_(code), message_(std::move(message)) {}

  bool ok() const { return code_ == Code::ok; }  ///< no failure
  explicit operator bool() const { return ok(); }  ///< the same as ok()
  Code code() const { return code_; }  ///< kind of failure
  const std::string& message() const { return message_; }  ///< one line; empty: success

 private:
  Code code_ = Code::ok;
  std::string message_;
};

/// A value, or the Status that says why there is none. `value()` may be called only when `ok()`.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::move(value)) {}  ///< success
  Result(Status failure) : state_(std::move(failure)) {}  ///< a failure

  bool ok() const { return state_.index() == 0; }  ///< there is a value
  explicit operator bool() const { return ok(); }  ///< the same as ok()
  T& value() & { return *std::get_if<0>(&state_); }  ///< the value
  const T& value() const& { return *std::get_if<0>(&state_); }  ///< the value
  T&& value() && { return std::move(*std::get_if<0>(&state_)); }  ///< the value, moved out
  Status status() const { return ok() ? Status() : *std::get_if<1>(&state_); }  ///< success, or why there is no value

 private:
  std::variant<T, Status> state_;
};

}  // namespace luxel
