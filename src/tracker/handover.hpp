// Handing values to the control loop without locks on its side.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>

namespace otter_nav::tracker {

// The latest value from any thread to one taker that neither waits nor allocates nor frees: what
// the taker lets go of is freed by the next giver.
template <typename T>
class Handover {
 public:
  Handover() = default;
  Handover(const Handover&) = delete;
  Handover& operator=(const Handover&) = delete;
  ~Handover() {
    delete pending_.load();
    delete retired_.load();
  }

  void give(std::unique_ptr<T> value) {
    const std::lock_guard<std::mutex> lock(givers_);
    delete retired_.exchange(nullptr);
    delete pending_.exchange(value.release());
  }

  // Replaces `current` by the latest value given since the last call, if any. Between two givings
  // at most one value is retired, and giving empties the place first.
  bool take(std::unique_ptr<T>& current) {
    if (pending_.load(std::memory_order_relaxed) == nullptr || retired_.load() != nullptr) {
      return false;
    }
    T* latest = pending_.exchange(nullptr);
    if (latest == nullptr) {
      return false;
    }
    retired_.store(current.release());
    current.reset(latest);
    return true;
  }

 private:
  std::mutex givers_;
  std::atomic<T*> pending_{nullptr};
  std::atomic<T*> retired_{nullptr};
};

// Values in sequence from one thread to one other. A full ring refuses.
template <typename T, std::size_t Size>
class Ring {
 public:
  bool push(const T& value) {
    const std::size_t head = head_.load(std::memory_order_relaxed);
    if (head - tail_.load(std::memory_order_acquire) == Size) {
      return false;
    }
    values_[head % Size] = value;
    head_.store(head + 1, std::memory_order_release);
    return true;
  }

  bool pop(T& value) {
    const std::size_t tail = tail_.load(std::memory_order_relaxed);
    if (tail == head_.load(std::memory_order_acquire)) {
      return false;
    }
    value = values_[tail % Size];
    tail_.store(tail + 1, std::memory_order_release);
    return true;
  }

 private:
  std::array<T, Size> values_{};
  std::atomic<std::size_t> head_{0};
  std::atomic<std::size_t> tail_{0};
};

}  // namespace otter_nav::tracker
