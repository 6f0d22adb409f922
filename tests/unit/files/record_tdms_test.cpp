#include "from_bytes.h"
#include "tdms_made.h"

#include <gtest/gtest.h>
#include <trochoid/files/record_source.h>
#include <trochoid/files/tdms.h>

#include <sstream>

namespace trochoid::files::record_tdms_test {

constexpr RecordFrom read{"r.tdms"};
constexpr RefusalFrom refusal{"r.tdms"};

TEST(RecordTdms, ReadsSegmentsOfEitherByteOrder) {
  for (const bool big : {false, true}) {
    const auto record = read(made::tdms_record(big));
    EXPECT_EQ(record.channel[0], (std::vector<double>{1, 2, 3, 4, 5, 6, 7, 8, 9}));
    EXPECT_EQ(record.channel[1],
              (std::vector<double>{10, 20, 30, 40, 50, 60, 70, 80, 90}));
    EXPECT_EQ(record.channel[2][8], 900.0);
    EXPECT_DOUBLE_EQ(record.sample_rate, 1e4);
    EXPECT_DOUBLE_EQ(record.time[8], 0.5008);
    EXPECT_EQ(record.channel_column[0], "Fx");
    EXPECT_TRUE(record.notes.empty());
  }
}

TEST(RecordTdms, ReadsChunksAndInterleavedNumbers) {
  made::Tdms head;
  head.u32(3);
  for (const char* name : {"Fx", "Fy", "Fz"}) made::force_channel(head, name, 1);
  using namespace made;
  const auto data = numbers({1, 10, 100, 2, 20, 200, 3, 30, 300});
  // One number of each channel is a chunk: both orders are the same bytes.
  for (const auto how : {0U, interleaved}) {
    const auto record = read(segment(metadata | new_list | raw_data | how, head, data));
    EXPECT_EQ(record.channel[0], (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(record.channel[2], (std::vector<double>{100, 200, 300}));
  }
}

TEST(RecordTdms, ScalesTheRawNumbersOfDaqmx) {
  made::Tdms head;
  head.u32(3);
  std::uint32_t offset = 0;
  for (const char* name : {"Fx", "Fy", "Fz"}) {
    head.text("/'Cut'/'" + std::string(name) + "'").u32(0x1269).u32(0xFFFFFFFF).u32(1);
    head.u64(2).u32(1).u32(3).u32(0).u32(offset).u32(0).u32(0).u32(1).u32(6);
    head.u32(9).property("unit_string", std::string("N"));
    head.property("wf_increment", 1e-4).property("NI_Number_Of_Scales", 3);
    head.property("NI_Scale[1]_Scale_Type", std::string("Linear"));
    head.property("NI_Scale[1]_Linear_Slope", 0.5);
    head.property("NI_Scale[1]_Linear_Y_Intercept", 10)
        .property("NI_Scale[1]_Linear_Input_Source", 0);
    head.property("NI_Scale[2]_Scale_Type", std::string("Linear"));
    head.text("NI_Scale[2]_Linear_Input_Source").u32(7).u32(1);
    offset += 2;
  }
  made::Tdms data;
  for (const int raw : {1, -2, 3, 4, 5, -600}) {
    data.whole(static_cast<std::uint16_t>(static_cast<std::int16_t>(raw)));
  }
  using namespace made;
  const auto bytes =
      segment(metadata | new_list | raw_data | interleaved | daqmx, head, data.bytes);
  const auto record = read(bytes);
  EXPECT_EQ(record.channel[0], (std::vector{10.5, 12.0}));
  EXPECT_EQ(record.channel[1], (std::vector{9.0, 12.5}));
  EXPECT_EQ(record.channel[2], (std::vector{11.5, -290.0}));
  auto table = bytes;
  for (auto at = table.find("Linear", table.find("Scale_Type"));
       at != std::string::npos; at = table.find("Linear", at)) {
    table.replace(at, 6, "Tabled");
  }
  EXPECT_EQ(refusal(table),
            "r.tdms: channel \"Fx\" is scaled by \"Tabled\", which is not read, only "
            "Linear and Polynomial: save it as scaled numbers\n");
}

TEST(RecordTdms, TellsChannelsOfOneNameByTheirGroups) {
  auto bytes = made::tdms_record();
  std::istringstream in(bytes);
  EXPECT_EQ(tdms_table(in, "r").columns[1].path, "Cut/Fy");
  RecordSource m;
  m.columns = {"Cut/Fz", "Cut/Fy", "Fx"};
  EXPECT_EQ(read(bytes, m).channel[0][0], 100.0);
}

TEST(RecordTdms, ReadsAFileThatWasNotClosedAsFarAsItGoes) {
  auto bytes = made::tdms_record();
  const auto last = bytes.rfind("TDSm");
  bytes.replace(last + 12, 8, 8, '\xFF');
  const auto record = read(bytes);
  EXPECT_EQ(record.size(), 9u);
  ASSERT_EQ(record.notes.size(), 1u);
  EXPECT_EQ(record.notes[0].code, "part_of_record");
  bytes.resize(bytes.size() - 5);
  EXPECT_EQ(read(bytes).size(), 6u) << "the last chunk is not whole";
}

TEST(RecordTdms, IsCutOffNowhereWithoutAWord) {
  const auto bytes = made::tdms_record();
  for (int tenth = 1; tenth < 10; ++tenth) {
    const auto part =
        bytes.substr(0, bytes.size() * static_cast<std::size_t>(tenth) / 10);
    EXPECT_NE(refusal(part).find("cut off"), std::string::npos) << tenth;
  }
}

TEST(RecordTdms, PromisesNoMoreThanItHolds) {
  auto bytes = made::tdms_record();
  const auto values = bytes.find("/'Cut'/'Fx'") + 11 + 12;
  bytes[values + 6] = 1;  // 2^48 more samples
  EXPECT_NE(refusal(bytes).find("are fewer than its channels have"), std::string::npos);
}

TEST(RecordTdms, IsRefusedUnderAnotherName) {
  RecordSource m;
  m.format = RecordFormat::csv;
  EXPECT_EQ(refusal(made::tdms_record(), m),
            "r.tdms:1:1: this is a TDMS file, but the case file says format = \"csv\": "
            "\"tdms\" is right\n");
  m.format = RecordFormat::tdms;
  EXPECT_EQ(refusal(made::tdms_record(), m), "");
  EXPECT_EQ(refusal("angle_deg,Fx_N,Fy_N,Fz_N\n0,1,2,3\n1,1,2,3\n", m),
            "r.tdms:1:1: the case file says format = \"tdms\", but a TDMS file begins "
            "with `TDSm`\n");
}

TEST(RecordTdms, NeverBreaksOnASingleWrongByte) {
  const auto good = made::tdms_record();
  for (std::size_t at = 0; at < good.size(); ++at) {
    for (const int flip : {0x01, 0x80, 0xFF}) {
      auto bytes = good;
      bytes[at] = static_cast<char>(bytes[at] ^ flip);
      try {
        const auto record = read(bytes);
        EXPECT_GE(record.size(), 2u);
      } catch (const base::InputError& error) {
        EXPECT_FALSE(error.problems().empty());
      }
    }
  }
}

}  // namespace trochoid::files::record_tdms_test
