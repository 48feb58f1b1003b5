// What accuracy costs in time, through the C++ face: the list, a choice, and its clump.
#include <cstdio>
#include <morula.hpp>

static int made = 0, failed = 0;
#define CHECK(condition)                                                           \
  do {                                                                             \
    ++made;                                                                        \
    if (!(condition)) {                                                            \
      ++failed;                                                                    \
      std::fprintf(stderr, "%s:%d: not so: %s\n", __FILE__, __LINE__, #condition); \
    }                                                                              \
  } while (0)

int main() {
  const morula::Solid solid(morula::Shape::from_primitive("stone"));
  morula::ClumpOptions how;
  how.effort = MORULA_EFFORT_DRAFT;
  morula::CostOptions options;
  options.most = 20;
  double done = 0;
  const morula::Cost list(solid, how, options, [&](double fraction) {
    CHECK(fraction >= done);
    done = fraction;
    return true;
  });
  const auto points = list.points();
  CHECK(points.size() == list.size() && !list.cut() && done > 0.9);
  CHECK(points.front().spheres == 1 && points.back().spheres == 20);
  morula::CostBounds bounds;
  bounds.goal = MORULA_GOAL_MISMATCH;
  bounds.step_cost = points[5].step_cost;
  const auto choice = list.choose(bounds);
  CHECK(choice.index == 5 && choice.why.find("least mismatch") != std::string::npos);
  std::puts(choice.why.c_str());
  const morula::Clump clump = list.clump(choice.index);
  CHECK(clump.size() == points[5].spheres && clump.overlap().mismatch == points[5].mismatch);
  CHECK(list.choose().index < points.size());
  try {
    list.clump(points.size());
    CHECK(false);
  } catch (const morula::Error &error) {
    CHECK(error.status() == MORULA_STATUS_INDEX_OUT_OF_RANGE);
  }
  std::printf("%d checks, %d failed\n", made, failed);
  return failed != 0;
}
