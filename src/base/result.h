// A value or the error that prevented it. Bad input is a Result; a bug is SWELL_CHECK.
#ifndef SWELL_BASE_RESULT_H_
#define SWELL_BASE_RESULT_H_

#include <string>
#include <utility>
#include <variant>

namespace swell {

// One line for a person: what, where and the remedy ("scene.pbrt:12: unknown type 'difuse'; ...").
struct Error {
  std::string message;
};

template <class T> class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::move(value)) {}      // NOLINT: a value is a result
  Result(Error error) : state_(std::move(error)) {}  // NOLINT: so is an error

  explicit operator bool() const { return std::holds_alternative<T>(state_); }
  T& operator*() { return std::get<T>(state_); }
  const T& operator*() const { return std::get<T>(state_); }
  T* operator->() { return &std::get<T>(state_); }
  const T* operator->() const { return &std::get<T>(state_); }
  const Error& error() const { return std::get<Error>(state_); }

 private:
  std::variant<T, Error> state_;
};

struct Done {};
using Status = Result<Done>;

}  // namespace swell

#endif  // SWELL_BASE_RESULT_H_
