#include <trochoid/run/progress.h>

#include <gtest/gtest.h>

namespace trochoid::run::progress_test {

TEST(Progress, SaysWhatIsDoneAndForHowLong) {
  EXPECT_EQ(progress_text("Fitting", 12.4, 3.0), "Fitting, 12 s");
}

TEST(Progress, AShareTellsWhatIsLeft) {
  // a quarter took 5 s of this step: three more quarters take 15 s
  EXPECT_EQ(progress_text({"limit depth", 0.25}, 12.0, 5.0),
            "limit depth: 25 %, 12 s, about 15 s left");
  EXPECT_EQ(progress_text({"limit depth", 0.25}, 700.0, 100.0),
            "limit depth: 25 %, 12 min, about 5 min left");
}

TEST(Progress, NothingIsForetoldFromTooLittle) {
  EXPECT_EQ(progress_text({"limit depth", 0.01}, 2.0, 2.0), "limit depth: 1 %, 2 s");
  EXPECT_EQ(progress_text({"limit depth", 1.0}, 9.0, 9.0), "limit depth: 100 %, 9 s");
}

TEST(Progress, ATextIsAStepOfUnknownShare) {
  std::string said;
  const Progress progress = [&](const Step& step) {
    said = progress_text(step, 1.0, 1.0);
  };
  progress(std::string("Reading"));
  EXPECT_EQ(said, "Reading, 1 s");
}

}  // namespace trochoid::run::progress_test
