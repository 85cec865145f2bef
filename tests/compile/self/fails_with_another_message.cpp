// expect: never printed by a compiler
static_assert(false, "the wrong reason");
