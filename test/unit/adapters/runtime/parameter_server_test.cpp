#include "adapters/runtime/parameter_server.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "refusal.hpp"

namespace window_ingress::adapters::parameter_server_test {

struct Inner {
  double gain = 0.5;
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("gain", self.gain, 0.0, 1.0);
  }
};

struct Outer {
  double speed = 1.0;
  int count = 3;
  bool wanted = false;
  std::string name = "a", mode = "slow";
  std::vector<double> list;
  Inner inner;
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("speed", self.speed, 0.0, 2.0);
    field("count", self.count, 0, 10);
    field("wanted", self.wanted);
    field("name", self.name);
    field.choice("mode", self.mode, {"slow", "fast"});
    field("list", self.list);
    field.group("inner", self.inner);
  }
};

struct Read {
  Outer params;
  std::vector<std::string> faults;
};

Read read(const XmlRpc::XmlRpcValue& tree) {
  Read result;
  result.faults = readTree("/node", tree, parameters::fieldsOf(result.params));
  return result;
}

XmlRpc::XmlRpcValue emptyTree() {
  XmlRpc::XmlRpcValue tree;
  tree.begin();
  return tree;
}

template <typename Value>
std::vector<std::string> faultsOf(const std::string& name, const Value& value) {
  XmlRpc::XmlRpcValue tree = emptyTree();
  tree[name] = value;
  return read(tree).faults;
}

TEST(Parameters, AChoiceIsOneOfItsWords) {
  XmlRpc::XmlRpcValue tree = emptyTree();
  tree["mode"] = "fast";
  EXPECT_EQ(read(tree).params.mode, "fast");
  EXPECT_TRUE(read(tree).faults.empty());
  tree["mode"] = "quick";
  ASSERT_EQ(read(tree).faults.size(), 1u);
  EXPECT_TRUE(test::says(read(tree).faults[0], "slow, fast"));
}

TEST(Parameters, MissingOnesKeepTheirDefaults) {
  const Read result = read(emptyTree());
  EXPECT_TRUE(result.faults.empty());
  EXPECT_EQ(result.params.speed, 1.0);
  EXPECT_EQ(result.params.inner.gain, 0.5);
}

TEST(Parameters, ReadsAllTypesAndTakesAnIntForADouble) {
  XmlRpc::XmlRpcValue tree = emptyTree();
  tree["speed"] = 2;
  tree["count"] = 7;
  tree["wanted"] = true;
  tree["name"] = std::string("b");
  tree["list"][0] = 1.5;
  tree["list"][1] = 2;
  tree["inner"]["gain"] = 0.25;
  const Read result = read(tree);
  EXPECT_TRUE(result.faults.empty());
  EXPECT_EQ(result.params.speed, 2.0);
  EXPECT_EQ(result.params.count, 7);
  EXPECT_TRUE(result.params.wanted);
  EXPECT_EQ(result.params.name, "b");
  EXPECT_EQ(result.params.list, (std::vector<double>{1.5, 2.0}));
  EXPECT_EQ(result.params.inner.gain, 0.25);
}

TEST(Parameters, RefusesWrongTypesByName) {
  EXPECT_EQ(faultsOf("speed", std::string("0.5")).at(0), "/node/speed must be a number, not a text");
  EXPECT_EQ(faultsOf("wanted", 1).at(0), "/node/wanted must be true or false, not a whole number");
  EXPECT_EQ(faultsOf("count", 2.0).size(), 1u);
  EXPECT_EQ(faultsOf("name", 2).size(), 1u);
  EXPECT_EQ(faultsOf("list", 2).size(), 1u);
  EXPECT_EQ(faultsOf("inner", 2).at(0),
            "/node/inner must be a mapping of names to values, not a whole number");
}

TEST(Parameters, RefusesNumbersOutOfRange) {
  for (const double value :
       {-0.1, 2.1, 1e300, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_EQ(faultsOf("speed", value).size(), 1u) << value;
  XmlRpc::XmlRpcValue list;
  list[0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(faultsOf("list", list).size(), 1u);
}

TEST(Parameters, NamesEveryUnknownOneAtEveryDepth) {
  XmlRpc::XmlRpcValue tree = emptyTree();
  tree["sped"] = 1.0;
  tree["inner"]["gian"] = 0.5;
  const auto faults = read(tree).faults;
  ASSERT_EQ(faults.size(), 2u);
  EXPECT_TRUE(test::says(parameters::joined(faults), "unknown parameter /node/sped"));
  EXPECT_TRUE(test::says(parameters::joined(faults), "unknown parameter /node/inner/gian"));
}

TEST(Parameters, AllFaultsComeInOneError) {
  XmlRpc::XmlRpcValue tree = emptyTree();
  tree["speed"] = 5.0;
  tree["count"] = -1;
  Outer params;
  const std::string text =
      test::refusalOf([&] { refuseFaulty(readTree("/node", tree, parameters::fieldsOf(params))); });
  EXPECT_TRUE(test::says(text, "/node/speed"));
  EXPECT_TRUE(test::says(text, "/node/count"));
  EXPECT_EQ(text.find('\n'), std::string::npos);
}

TEST(Parameters, NamesReadByOthersAreNoFault) {
  XmlRpc::XmlRpcValue tree = emptyTree();
  tree["tuning"]["x"] = 1;
  Outer params;
  EXPECT_TRUE(readTree("/node", tree, parameters::fieldsOf(params), {"tuning"}).empty());
}

}  // namespace window_ingress::adapters::parameter_server_test
