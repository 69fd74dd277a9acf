// A GigE Vision camera on the loopback interface, for tests to start and to kill.
#include <arv.h>

#include <chrono>
#include <cstdio>
#include <thread>

int main() {
  ArvGvFakeCamera* camera = arv_gv_fake_camera_new("127.0.0.1", "GV01");
  if (!camera || !arv_gv_fake_camera_is_running(camera)) {
    std::fprintf(stderr, "fake_gv_camera: cannot use 127.0.0.1\n");
    return 1;
  }
  // Ends by itself, should the test be killed.
  std::this_thread::sleep_for(std::chrono::minutes(5));
  g_object_unref(camera);
  return 0;
}
