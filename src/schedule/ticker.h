// Calls a function from a thread of its own while it lives.
#ifndef SWELL_SCHEDULE_TICKER_H_
#define SWELL_SCHEDULE_TICKER_H_

#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

namespace swell {

// Ten times a second and once at the end; never if `tick` is empty.
class Ticker {
 public:
  explicit Ticker(std::function<void()> tick);
  ~Ticker();
  Ticker(const Ticker&) = delete;
  Ticker& operator=(const Ticker&) = delete;

 private:
  void Run();

  const std::function<void()> tick_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool stop_ = false;
  std::thread thread_;
};

}  // namespace swell

#endif  // SWELL_SCHEDULE_TICKER_H_
