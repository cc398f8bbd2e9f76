#ifndef TURNSCAN_CAPTURE_PLUGIN_H
#define TURNSCAN_CAPTURE_PLUGIN_H
/* What a driver of depth sensors offers to turnscan: a shared library named turnscan-NAME.so in a
 * folder of plug-ins, with one function, turnscan_plugin_entry. Plain C, so that a plug-in needs no
 * library of turnscan and any compiler. docs/reference/devices.md tells how to write one.
 *
 * Rules: all text is UTF-8 and ends with a zero. A function that can fail returns one of
 * turnscan_status; when that is negative it has filled the error. turnscan calls the functions of
 * one device from one thread at a time; list() and open() may be called while devices are open.
 * A plug-in writes nothing to standard output. */

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Raised when anything here changes. turnscan refuses a plug-in of another version. */
#define TURNSCAN_PLUGIN_VERSION 1

enum turnscan_status {
  TURNSCAN_OK = 0,      /* of grab(): there is a frame */
  TURNSCAN_NOTHING = 1, /* of grab(): no frame within the timeout */
  TURNSCAN_END = 2,     /* of grab(): a file is at its end */
  TURNSCAN_NOT_FOUND = -1,
  TURNSCAN_BUSY = -2,   /* another program has the device */
  TURNSCAN_LOST = -3,   /* the device went away */
  TURNSCAN_DENIED = -4, /* this user may not open the device */
  TURNSCAN_BAD_PARAMETER = -5,
  TURNSCAN_UNSUPPORTED = -6, /* the device cannot do what is needed */
  TURNSCAN_FAILED = -7       /* anything else */
};

typedef struct turnscan_error {
  char text[512]; /* one sentence, without a full stop: what is wrong; what to do */
} turnscan_error;

/* A device as list() finds it. */
typedef struct turnscan_device_entry {
  char address[256]; /* what open() takes */
  char model[64];
  char serial[64]; /* empty: unknown */
} turnscan_device_entry;

/* A parameter of the URI that open() understands. */
typedef struct turnscan_parameter_info {
  const char* name;
  const char* help;
  const char* default_value;
} turnscan_parameter_info;

typedef struct turnscan_parameter {
  const char* name;
  const char* value;
} turnscan_parameter;

/* Pinhole camera, pixels; the centre of the top left pixel is (0, 0); distortion is k1 k2 p1 p2 k3
 * (Brown 1971, the order of OpenCV). */
typedef struct turnscan_camera {
  int32_t width, height;
  double fx, fy, cx, cy;
  double distortion[5];
} turnscan_camera;

enum turnscan_depth_kind {
  TURNSCAN_DEPTH_STEPS = 0, /* uint16_t in steps of depth_unit_m; 0: no return */
  TURNSCAN_DEPTH_METRES = 1 /* float, metres; not finite or not positive: no return */
};

enum turnscan_color_kind {
  TURNSCAN_COLOR_NONE = 0,
  TURNSCAN_COLOR_REGISTERED = 1, /* on the depth image, pixel by pixel */
  TURNSCAN_COLOR_OWN = 2         /* with color_camera and T_color_depth */
};

typedef struct turnscan_device_info {
  char model[64];
  char serial[64];
  turnscan_camera camera;
  int32_t depth_kind;
  double depth_unit_m; /* of TURNSCAN_DEPTH_STEPS */
  double fps;          /* nominal; 0: unknown */
  int32_t color_kind;
  turnscan_camera color_camera;
  double T_color_depth[12]; /* three rows of four: takes points, in metres, to the colour camera */
  int32_t live;             /* 0: a file, read as fast as its frames are taken */
  uint64_t frame_count;     /* of a file; 0: unknown */
} turnscan_device_info;

/* Depth is distance along the optical axis. What the pointers name stays as it is until the next
 * call for this device. */
typedef struct turnscan_frame {
  const void* depth; /* rows one behind the other, without gaps */
  int32_t width, height;
  const uint8_t* color; /* red, green, blue; rows without gaps; NULL: none with this frame */
  int32_t color_width, color_height;
  double time_s;   /* the sensor's clock; only ever forward */
  uint64_t number; /* counts the sensor's frames, so that gaps show; 0: unknown */
} turnscan_frame;

typedef struct turnscan_device turnscan_device;

typedef struct turnscan_plugin {
  uint32_t version;        /* TURNSCAN_PLUGIN_VERSION as it was compiled */
  const char* name;        /* scheme of its URIs: lower case letters, digits and '-' */
  const char* description; /* for people: "Kinect for Xbox 360 (libfreenect)" */
  const turnscan_parameter_info* parameters;
  int32_t parameter_count;

  /* Fills up to capacity entries and returns how many devices there are, or a negative status. */
  int32_t (*list)(turnscan_device_entry* entries, int32_t capacity, turnscan_error* error);
  /* Opens the device of that address, or the first one for an empty text, without starting it.
   * parameters: those of the URI, each at most once, all with a name of `parameters`. */
  int32_t (*open)(const char* address, const turnscan_parameter* parameters, int32_t count,
                  turnscan_device** device, turnscan_error* error);
  /* Of an open device; does not change. */
  int32_t (*describe)(turnscan_device* device, turnscan_device_info* info, turnscan_error* error);
  int32_t (*start)(turnscan_device* device, turnscan_error* error);
  /* TURNSCAN_OK, TURNSCAN_NOTHING, TURNSCAN_END or a negative status. */
  int32_t (*grab)(turnscan_device* device, double timeout_s, turnscan_frame* frame,
                  turnscan_error* error);
  void (*stop)(turnscan_device* device);
  void (*close)(turnscan_device* device); /* also of a started device */
} turnscan_plugin;

/* What the shared library exports under the name "turnscan_plugin_entry": its table, which stays
 * for as long as the library is loaded. */
typedef const turnscan_plugin* (*turnscan_plugin_entry_function)(void);

#ifdef __cplusplus
}
#endif
#endif
