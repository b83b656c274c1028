#pragma once

#include <boost/thread/condition.hpp>  // included by the original, too: programs use it without including it
#include <boost/thread/mutex.hpp>

#include <condition_variable>
#include <mutex>

namespace actionlib {

/** Keeps an object alive while callbacks use it: its destructor waits for them, and no others begin. */
class DestructionGuard {
 public:
  DestructionGuard() {}
  DestructionGuard(const DestructionGuard&) = delete;
  DestructionGuard& operator=(const DestructionGuard&) = delete;

  /** Refuse further users, and wait until those that are there have ended. */
  void destruct() {
    std::unique_lock<std::mutex> lock(mutex_);
    is_destructing_ = true;
    changed_.wait(lock, [this] { return users_ == 0; });
  }
  /** Begin to use the object; false if it is being destroyed. */
  bool tryProtect() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (is_destructing_) return false;
    ++users_;
    return true;
  }
  void unprotect() {
    const std::lock_guard<std::mutex> lock(mutex_);
    --users_;
    changed_.notify_all();
  }

  /** Use of an object while this variable exists. */
  class ScopedProtector {
   public:
    explicit ScopedProtector(DestructionGuard& guard) : guard_(guard), is_protected_(guard.tryProtect()) {}
    ScopedProtector(const ScopedProtector&) = delete;
    ScopedProtector& operator=(const ScopedProtector&) = delete;
    ~ScopedProtector() {
      if (is_protected_) guard_.unprotect();
    }
    bool isProtected() const { return is_protected_; }

   private:
    DestructionGuard& guard_;
    const bool is_protected_;
  };

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  unsigned users_ = 0;
  bool is_destructing_ = false;
};

}  // namespace actionlib
