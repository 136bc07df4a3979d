// A fixed set of threads for loops whose iterations do not touch one another.
#pragma once
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace minirtc {

class ThreadPool {
public:
    /// `threads` counts the calling thread; 0: one a core.
    explicit ThreadPool(unsigned threads);
    ~ThreadPool();
    ThreadPool(const ThreadPool&) = delete;
    ThreadPool& operator=(const ThreadPool&) = delete;

    unsigned size() const { return static_cast<unsigned>(workers_.size()) + 1; }

    /// Calls task(i) once for each i < count, in any order on any thread, the caller's included; returns when all have returned.
    /// `task` must not throw and must not call parallelFor of the same pool.
    void parallelFor(size_t count, const std::function<void(size_t)>& task);

private:
    void work();
    void runTasks(std::unique_lock<std::mutex>& lock);

    std::mutex mutex_;
    std::condition_variable started_, finished_;
    std::vector<std::thread> workers_;
    const std::function<void(size_t)>* task_ = nullptr;
    size_t count_ = 0;  // iterations of the running loop
    size_t next_ = 0;   // the first one that no thread has taken
    size_t done_ = 0;
    bool stop_ = false;
};

}  // namespace minirtc
