// The replaced functions of lock_watch.hpp.
#include <ctime>
#include <dlfcn.h>
#include <pthread.h>
#include <realtime/lock_watch.hpp>
#include <semaphore.h>

namespace {

thread_local bool watching = false;
thread_local long count = 0;

/// The C library's own function of a name.
template <typename Function>
Function* original(Function*& cached, const char* name) noexcept {
  if (cached == nullptr) cached = reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
  return cached;
}

}  // namespace

namespace hapbeam::testing {

void begin_lock_watch() noexcept {
  count = 0;
  watching = true;
}
long end_lock_watch() noexcept {
  watching = false;
  return count;
}

}  // namespace hapbeam::testing

#define HAPBEAM_WATCHED(name, parameters, ...) \
  int name parameters noexcept {               \
    static int(*next) parameters = nullptr;    \
    if (watching) ++count;                     \
    return original(next, #name)(__VA_ARGS__); \
  }

extern "C" {

HAPBEAM_WATCHED(pthread_mutex_lock, (pthread_mutex_t * mutex), mutex)
HAPBEAM_WATCHED(pthread_mutex_trylock, (pthread_mutex_t * mutex), mutex)
HAPBEAM_WATCHED(pthread_rwlock_rdlock, (pthread_rwlock_t * lock), lock)
HAPBEAM_WATCHED(pthread_rwlock_wrlock, (pthread_rwlock_t * lock), lock)

// These may be cancelled, so they are not noexcept.
int pthread_cond_wait(pthread_cond_t* condition, pthread_mutex_t* mutex) {
  static int (*next)(pthread_cond_t*, pthread_mutex_t*) = nullptr;
  if (watching) ++count;
  return original(next, "pthread_cond_wait")(condition, mutex);
}
int sem_wait(sem_t* semaphore) {
  static int (*next)(sem_t*) = nullptr;
  if (watching) ++count;
  return original(next, "sem_wait")(semaphore);
}

}  // extern "C"
