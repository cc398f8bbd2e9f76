#include <gtest/gtest.h>

#include <turnscan/workflow/file_roles.hpp>

#include "tests/support/temp_folder.hpp"

namespace turnscan {
namespace {

namespace fs = std::filesystem;
using testing::TempFolder;

struct Roles : ::testing::Test {
  Roles() {
    fs::create_directories(folder / "rec/depth");
    folder.put("rec/recording.json", "x");
    folder.put("rec/depth/0.png", "x");
    folder.put("a.ply", "x");
  }
  std::string at(const char* name) const { return (folder / name).string(); }
  bool allowed(std::vector<std::string> inputs, std::vector<std::string> outputs) const {
    const auto checked = check_file_roles({std::move(inputs), std::move(outputs)});
    if (!checked) {
      EXPECT_EQ(checked.error().code, ErrorCode::kInvalidOption);
    }
    return checked.has_value();
  }
  /// With a mesh after which those of several objects and passes are numbered.
  bool allowed_numbered(const char* input, const char* mesh, const char* other) const {
    return check_file_roles({{at(input)}, {at(mesh), at(other)}, at(mesh)}).has_value();
  }
  const TempFolder folder;
};

TEST_F(Roles, AnOutputIsNoInput) {
  EXPECT_FALSE(allowed({at("a.ply")}, {at("a.ply")}));
  EXPECT_FALSE(allowed({at("rec/../a.ply")}, {at("a.ply")}));
  EXPECT_FALSE(allowed({at("rec")}, {at("b.ply"), at("rec/recording.json")}));
  EXPECT_FALSE(allowed({at("rec")}, {at("rec/depth/0.png")}));
}

TEST_F(Roles, LinksAreTheFilesThatTheyLeadTo) {
  fs::create_symlink(at("a.ply"), at("soft.ply"));
  fs::create_hard_link(at("rec/depth/0.png"), at("hard.png"));
  EXPECT_FALSE(allowed({at("a.ply")}, {at("soft.ply")}));
  EXPECT_FALSE(allowed({at("soft.ply")}, {at("a.ply")}));
  EXPECT_FALSE(allowed({at("rec")}, {at("hard.png")}));
}

TEST_F(Roles, TwoOutputsAreTwoFiles) {
  EXPECT_FALSE(allowed({}, {at("b.ply"), at("b.ply")}));
  EXPECT_FALSE(allowed({}, {at("b.ply"), at("rec/../b.ply")}));
  fs::create_hard_link(at("a.ply"), at("b.ply"));
  EXPECT_FALSE(allowed({}, {at("a.ply"), at("b.ply")}));
}

TEST_F(Roles, FilesOfSeveralObjectsAreOutputs) {
  folder.put("rec/scan-12.ply", "x");
  folder.put("b-1.ply", "x");
  fs::create_hard_link(at("b-1.ply"), at("rec/hard.ply"));
  EXPECT_FALSE(allowed_numbered("rec", "rec/scan.ply", "r.json"));
  EXPECT_FALSE(allowed_numbered("rec", "b.ply", "r.json"));
  EXPECT_FALSE(allowed_numbered("a.ply", "new.ply", "new-3.ply"));
  EXPECT_FALSE(allowed_numbered("a.ply", "new.ply", "rec/../new-3.ply"));
  EXPECT_FALSE(allowed_numbered("a.ply", "b.ply", "rec/hard.ply"));
  EXPECT_TRUE(allowed_numbered("rec", "rec/scan.glb", "r.json"));
  EXPECT_TRUE(allowed_numbered("rec", "rec/sca.ply", "rec/sca-fitted.ply"));
  EXPECT_TRUE(allowed_numbered("a.ply", "new.ply", "new-03.ply"));
  EXPECT_TRUE(allowed_numbered("a.ply", "new.ply", "rec/new-3.ply"));
  EXPECT_TRUE(allowed_numbered("a.ply", "b.ply", "c.json"));
}

TEST_F(Roles, FilesOfPassesThatDoNotFitAreOutputs) {
  folder.put("rec/scan-pass2.ply", "x");
  folder.put("rec/whole-pass12.3mf", "x");
  EXPECT_FALSE(allowed_numbered("rec", "rec/scan.ply", "r.json"));
  EXPECT_FALSE(allowed_numbered("rec", "rec/whole.3mf", "r.json"));
  EXPECT_FALSE(allowed_numbered("a.ply", "new.ply", "new-pass2.ply"));
  EXPECT_FALSE(allowed_numbered("a.ply", "new.ply", "new-pass2-1.ply"));
  EXPECT_TRUE(allowed_numbered("a.ply", "new.3mf", "new-pass2-1.3mf"));
  EXPECT_TRUE(allowed_numbered("a.ply", "new.ply", "new-pass.ply"));
  EXPECT_TRUE(allowed_numbered("a.ply", "new.ply", "new-pass2x.ply"));
}

TEST_F(Roles, NoInputLiesInAFolderThatIsEmptied) {
  const auto allowed_beside = [&](const std::string& input, const std::string& removed) {
    return check_file_roles({{input}, {}, {}, removed}).has_value();
  };
  fs::create_symlink(at("rec"), at("link"));
  EXPECT_FALSE(allowed_beside(at("rec"), at("rec")));
  EXPECT_FALSE(allowed_beside(at("rec/depth/0.png"), at("rec")));
  EXPECT_FALSE(allowed_beside(at("rec/depth/0.png"), at("link")));
  EXPECT_FALSE(allowed_beside(at("link/depth"), at("rec")));
  EXPECT_TRUE(allowed_beside(at("a.ply"), at("rec")));
  EXPECT_TRUE(allowed_beside(at("rec"), at("rec/depth/new")));
  EXPECT_TRUE(allowed_beside("builtin:cube", at("rec")));
  EXPECT_TRUE(allowed_beside(at("rec"), ""));
}

TEST_F(Roles, WhatDestroysNothingIsAllowed) {
  EXPECT_TRUE(allowed({at("rec"), at("a.ply"), "builtin:cube", ""}, {at("new.ply"), ""}));
  EXPECT_TRUE(allowed({at("rec")}, {at("a.ply"), at("rec/mesh.ply")}));
  EXPECT_TRUE(allowed({}, {"/dev/null", "/dev/null"}));
}

}  // namespace
}  // namespace turnscan
