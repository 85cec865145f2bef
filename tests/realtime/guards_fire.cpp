// A guard that cannot fire proves nothing: each way to the heap is taken on purpose and must be counted.
#include <atomic>
#include <cstdlib>
#include <functional>
#include <map>
#include <memory>
#include <new>
#include <realtime/heap_watch.hpp>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <Eigen/Core>

#include "support/catch.hpp"

using hapbeam::testing::heap_use;
using hapbeam::testing::HeapUse;
using hapbeam::testing::keep;

namespace {

/// Catches what it throws: nothing of it is seen outside but the heap.
bool throws_inside() noexcept {
  try {
    throw std::runtime_error("seen by nobody");
  } catch (const std::exception& error) {
    keep(error);
    return true;
  }
}

struct alignas(64) Aligned {
  double values[8];
};

}  // namespace

TEST_CASE("heap watch: what stays off the heap is not counted") {
  double numbers[64] = {};
  Eigen::Matrix<double, 6, 6> a = Eigen::Matrix<double, 6, 6>::Random(), b = a;
  CHECK(heap_use([&] {
          for (double& number : numbers) number += 1;
          keep(numbers);
          b = a * b;
          keep(b);
          std::free(nullptr);
        }) == HeapUse{});
}

TEST_CASE("heap watch: each function of the C library's allocator is counted, and so is its release") {
  const auto released = [](void* memory) {
    keep(memory);
    std::free(memory);
  };
  const HeapUse once{1, 1};
  CHECK(heap_use([&] { released(std::malloc(8)); }) == once);
  CHECK(heap_use([&] { released(std::calloc(2, 8)); }) == once);
  CHECK(heap_use([&] { released(std::aligned_alloc(64, 64)); }) == once);
  CHECK(heap_use([&] {
          void* memory = nullptr;
          if (posix_memalign(&memory, 64, 64) == 0) released(memory);
        }) == once);
  CHECK(heap_use([&] {
          void* memory = std::malloc(8);
          keep(memory);
          released(std::realloc(memory, 1 << 20));
        }) == HeapUse{2, 1});
}

TEST_CASE("heap watch: each form of new is counted") {
  const HeapUse once{1, 1};
  CHECK(heap_use([] {
          auto* p = new double(1);
          keep(p);
          delete p;
        }) == once);
  CHECK(heap_use([] {
          auto* p = new double[4];
          keep(p);
          delete[] p;
        }) == once);
  CHECK(heap_use([] {
          auto* p = new (std::nothrow) double(1);
          keep(p);
          delete p;
        }) == once);
  CHECK(heap_use([] {
          auto* p = new Aligned;
          keep(p);
          delete p;
        }) == once);
}

TEST_CASE("heap watch: what the standard library allocates is counted") {
  const auto seen = [](auto&& f) { return heap_use(f).allocations > 0; };
  CHECK(seen([] { keep(std::vector<double>(4)); }));
  CHECK(seen([] { keep(std::string(100, 'x')); }));
  CHECK(seen([] { keep(std::make_shared<int>(1)); }));
  CHECK(seen([] { keep(std::map<int, int>{{1, 2}}); }));
  const double captured[8] = {1};
  CHECK(seen([&] { keep(std::function<double(int)>([captured](int i) { return captured[i]; })); }));
}

TEST_CASE("heap watch: an exception is counted, even where it is caught before anyone sees it") {
  bool caught = false;
  CHECK(heap_use([&] { caught = throws_inside(); }).allocations > 0);
  CHECK(caught);
}

TEST_CASE("heap watch: what another thread does meanwhile is its own") {
  std::atomic<bool> go{false}, done{false};
  std::thread other([&] {
    while (!go) std::this_thread::yield();
    keep(std::vector<double>(9));
    done = true;
  });
  CHECK(heap_use([&] {
          go = true;
          while (!done) std::this_thread::yield();
        }) == HeapUse{});
  other.join();
}

TEST_CASE("heap watch: a dynamic temporary of Eigen is counted") {
  const Eigen::MatrixXd A = Eigen::MatrixXd::Random(9, 9);
  const Eigen::VectorXd b = Eigen::VectorXd::Random(9);
  Eigen::VectorXd x(9);
  const auto seen = [](auto&& f) { return heap_use(f).allocations > 0; };
  CHECK(seen([&] { x = A * b; }));
  CHECK(seen([&] { keep((A + A).eval()); }));
  CHECK(seen([&] { x.resize(12); }));
  // An expression bound to a Ref is copied to the heap.
  const auto first = [](const Eigen::Ref<const Eigen::VectorXd>& v) { return v[0]; };
  CHECK(seen([&] { x[0] = first(b + b); }));
}
