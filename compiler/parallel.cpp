#include "parallel.hpp"

#include <algorithm>

namespace minirtc {

ThreadPool::ThreadPool(unsigned threads) {
    if (threads == 0) threads = std::max(1u, std::thread::hardware_concurrency());
    for (unsigned i = 1; i < threads; ++i) workers_.emplace_back([this] { work(); });
}

ThreadPool::~ThreadPool() {
    {
        std::lock_guard<std::mutex> lock(mutex_);
        stop_ = true;
    }
    started_.notify_all();
    for (std::thread& worker : workers_) worker.join();
}

void ThreadPool::parallelFor(size_t count, const std::function<void(size_t)>& task) {
    std::unique_lock<std::mutex> lock(mutex_);
    task_ = &task, count_ = count, next_ = 0, done_ = 0;
    if (count > 1) started_.notify_all();
    runTasks(lock);
    finished_.wait(lock, [this] { return done_ == count_; });
}

void ThreadPool::work() {
    std::unique_lock<std::mutex> lock(mutex_);
    for (;;) {
        started_.wait(lock, [this] { return stop_ || next_ < count_; });
        if (stop_) return;
        runTasks(lock);
    }
}

/// Takes iterations until none is left; `lock` is held on entry and on return, but not while a task runs.
void ThreadPool::runTasks(std::unique_lock<std::mutex>& lock) {
    while (next_ < count_) {
        const size_t i = next_++;
        lock.unlock();
        (*task_)(i);
        lock.lock();
        if (++done_ == count_) finished_.notify_one();
    }
}

}  // namespace minirtc
