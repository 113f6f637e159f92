// Handing values to the control loop without locks on its side.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace otter_nav::tracker {

// The latest value from any thread to one taker that neither waits nor allocates nor frees. There
// is one place: the taker swaps what it lets go of for what is new, the next giver finds either
// there and frees it. So nothing is lost, whenever the two meet.
template <typename T>
class Handover {
 public:
  Handover() = default;
  Handover(const Handover&) = delete;
  Handover& operator=(const Handover&) = delete;
  ~Handover() { free(place_.load()); }

  void give(std::unique_ptr<T> value) {
    free(place_.exchange(reinterpret_cast<std::uintptr_t>(value.release()) | kNew));
  }

  // Replaces `current` by the latest value given since the last call, if any.
  bool take(std::unique_ptr<T>& current) {
    if ((place_.load(std::memory_order_relaxed) & kNew) == 0) {
      return false;
    }
    // Another giver may have come in between, with something newer still.
    current.reset(pointer(place_.exchange(reinterpret_cast<std::uintptr_t>(current.release()))));
    return true;
  }

 private:
  // In the last bit of an address, which is zero in all: the value has not been taken yet.
  static constexpr std::uintptr_t kNew = 1;
  static_assert(alignof(T) > kNew, "the last bit of its address is free");

  static T* pointer(std::uintptr_t place) { return reinterpret_cast<T*>(place & ~kNew); }
  static void free(std::uintptr_t place) { delete pointer(place); }

  std::atomic<std::uintptr_t> place_{0};
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
