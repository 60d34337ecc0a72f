#include "scene/readers.hpp"

namespace signorini {

void read_loads(Table& top, Scene& scene, RecordedScene& record) {
  const Space space = space_of(scene);
  for (Table& table : tables_of(top, "loads")) {
    LoadSpec load;
    load.place = table.place();
    if (!space.matrices) table.require("node", "");
    const std::string node = space.matrices ? "" : read_node(table, "node", space);
    load.direction = read_direction(table, "direction", space);
    load.direction.node = node;
    load.amplitude = table.number("amplitude");
    load.history = read_load_history(table, "history", directory_of(scene));
    table.finish("has no meaning with [matrices]");
    scene.loads.push_back(std::move(load));
    record.add("loads", "[[loads]]", table.record());
  }
}

}  // namespace signorini
