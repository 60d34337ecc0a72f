#include "model/element/element_kinds.hpp"

#include <algorithm>

#include "model/element/line_member.hpp"

namespace signorini {
namespace {

constexpr std::array kinds = {ElementKind{MemberType::beam, mesh_line_member, true},
                              ElementKind{MemberType::bar, mesh_line_member}};

}  // namespace

const ElementKind& kind_of(MemberType type) {
  return *std::find_if(kinds.begin(), kinds.end(), [type](const ElementKind& k) { return k.type == type; });
}

std::vector<MemberLine> lines_of(const Member& member) {
  const ElementKind& kind = kind_of(member.type);
  std::vector<MemberLine> lines;
  for (std::size_t i = 1; i < member.nodes.size(); ++i)
    lines.push_back(
        {member.nodes[i - 1], member.nodes[i], kind.bends, is_hinged(member, i - 1), is_hinged(member, i)});
  if (kind.closed) lines.push_back({member.nodes.back(), member.nodes.front(), kind.bends});
  return lines;
}

}  // namespace signorini
