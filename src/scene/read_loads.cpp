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

void read_base_motion(Table& top, Scene& scene, RecordedScene& record) {
  if (!top.has("base_motion")) return;
  Table table = top.child("base_motion");
  BaseMotionSpec motion;
  motion.place = table.place();
  motion.direction = read_direction(table, "direction", space_of(scene));
  table.require("acceleration", "");
  motion.acceleration = read_standing_history(table, "acceleration", directory_of(scene));
  table.finish();
  scene.base_motion = std::move(motion);
  record.add("base_motion", "[base_motion]", table.record());
}

}  // namespace signorini
