// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Ref<T>: a counted pointer to an immutable object that many shapes share. Copies of an empty Ref
// cost a test. T derives from RefCounted, whose count is atomic, so that Refs may cross threads; or
// from LocalRefCounted when all its Refs stay on one thread at a time.
#pragma once

#include <atomic>
#include <cstdint>
#include <utility>

namespace gable {

class RefCounted {
 public:
  RefCounted() = default;
  RefCounted(const RefCounted&) : count_(0) {}
  RefCounted& operator=(const RefCounted&) { return *this; }

  void addRef() const { count_.fetch_add(1, std::memory_order_relaxed); }
  /// True when this was the last reference.
  bool dropRef() const { return count_.fetch_sub(1, std::memory_order_acq_rel) == 1; }

 private:
  mutable std::atomic<uint32_t> count_{0};
};

class LocalRefCounted {
 public:
  LocalRefCounted() = default;
  LocalRefCounted(const LocalRefCounted&) {}
  LocalRefCounted& operator=(const LocalRefCounted&) { return *this; }

  void addRef() const { ++count_; }
  bool dropRef() const { return --count_ == 0; }

 private:
  mutable uint32_t count_ = 0;
};

template <class T>
class Ref {
 public:
  Ref() = default;
  explicit Ref(const T* p) : p_(p) {
    if (p_) p_->addRef();
  }
  Ref(const Ref& o) : p_(o.p_) {
    if (p_) p_->addRef();
  }
  Ref(Ref&& o) noexcept : p_(std::exchange(o.p_, nullptr)) {}
  Ref& operator=(Ref o) noexcept {
    std::swap(p_, o.p_);
    return *this;
  }
  ~Ref() {
    if (p_ && p_->dropRef()) delete p_;
  }

  const T* get() const { return p_; }
  const T& operator*() const { return *p_; }
  const T* operator->() const { return p_; }
  explicit operator bool() const { return p_ != nullptr; }
  friend bool operator==(const Ref& a, const Ref& b) { return a.p_ == b.p_; }

 private:
  const T* p_ = nullptr;
};

template <class T, class... Args>
Ref<T> makeRef(Args&&... args) {
  return Ref<T>(new T(std::forward<Args>(args)...));
}

}  // namespace gable
