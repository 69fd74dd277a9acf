// A library that registers nothing.
int of_no_use() {
  return 0;
}
