// Calls a function from a thread of its own while it lives.
#include "src/schedule/ticker.h"

#include <chrono>
#include <utility>

namespace swell {

Ticker::Ticker(std::function<void()> tick) : tick_(std::move(tick)) {
  if (tick_) thread_ = std::thread([this] { Run(); });
}

Ticker::~Ticker() {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    stop_ = true;
  }
  wake_.notify_one();
  if (thread_.joinable()) thread_.join();
}

void Ticker::Run() {
  std::unique_lock<std::mutex> lock(mutex_);
  while (!wake_.wait_for(lock, std::chrono::milliseconds(100), [this] { return stop_; })) tick_();
  tick_();
}

}  // namespace swell
