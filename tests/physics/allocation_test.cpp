// Steps of `boxes`, `push` and `quasi_static` allocate no memory, counted by operator new.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "physics/ContactScenes.h"

namespace {
std::atomic<long> n_allocations{0};
}

void* operator new(std::size_t size) {
  ++n_allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace heft {
namespace {

long allocations_in_steps(const std::string& name, const ContactScene& contact) {
  const auto simulator = make_simulator(name);
  simulator->reset(contact.scene, contact.path(0));
  std::vector<Pose> path;
  for (int i = 1; i < contact.duration_s * 240; ++i) path.push_back(contact.path(i / 240.0));
  const long before = n_allocations;
  for (const Pose& target : path) simulator->step(target, 1.0 / 240);
  return n_allocations - before;
}

TEST(Allocation, ABoxesStepAllocatesNothing) {
  for (const ContactScene& contact : contact_scenes::all())
    EXPECT_EQ(allocations_in_steps("boxes", contact), 0) << contact.name;
}

TEST(Allocation, APushStepAllocatesNothing) {
  const ContactScene contact{"push", one_cube(0.2), contact_scenes::smooth_push(0.1, 1)};
  EXPECT_EQ(allocations_in_steps("push", contact), 0);
  EXPECT_EQ(allocations_in_steps("quasi_static", contact), 0);
}

TEST(Allocation, IsCounted) {
  const long before = n_allocations;
  const auto simulator = make_simulator("boxes");
  simulator->reset(one_cube(0.2), Pose{});
  EXPECT_GT(n_allocations - before, 0);
}

}  // namespace
}  // namespace heft
