// SPDX-License-Identifier: Apache-2.0
#include "gpu/program.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "core/check.h"

namespace skysweep::gpu {
namespace {

constexpr std::int64_t kGroupsAlongX = 65535;  // what every OpenGL 4.5 takes

std::string log_of(GLuint object, decltype(glGetShaderiv) get, decltype(glGetShaderInfoLog) get_log) {
  GLint length = 0;
  get(object, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(0, length)), '\0');
  if (length > 0) get_log(object, length, nullptr, log.data());
  while (!log.empty() && (log.back() == '\0' || log.back() == '\n')) log.pop_back();
  return log;
}

GLuint compiled(const std::string& name, const std::string& text) {
  const GLuint shader = glCreateShader(GL_COMPUTE_SHADER);
  const char* source = text.c_str();
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  GLint done = GL_FALSE;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
  if (done) return shader;
  const std::string log = log_of(shader, glGetShaderiv, glGetShaderInfoLog);
  glDeleteShader(shader);
  throw DeviceError(Trouble::refused, "The GPU program " + name + " does not compile: " + log);
}

}  // namespace

Program::Program(Device& device, const std::string& name,
                 const std::vector<std::pair<std::string, std::string>>& definitions, const std::string& source)
    : device_(&device), name_(name) {
  std::string text = "#version 450 core\n";
  for (const auto& [macro, value] : definitions) text += "#define " + macro + " " + value + "\n";
  text += "#line 1\n" + source;
  const Current current(device);
  const GLuint shader = compiled(name, text);
  id_ = glCreateProgram();
  glAttachShader(id_, shader);
  glLinkProgram(id_);
  glDeleteShader(shader);
  GLint done = GL_FALSE;
  glGetProgramiv(id_, GL_LINK_STATUS, &done);
  if (!done) {
    const std::string log = log_of(id_, glGetProgramiv, glGetProgramInfoLog);
    glDeleteProgram(id_);
    throw DeviceError(Trouble::refused, "The GPU program " + name + " does not link: " + log);
  }
  device.check("compiling " + name);
}

Program::Program(Program&& other) noexcept
    : device_(other.device_), name_(std::move(other.name_)), id_(std::exchange(other.id_, 0)) {}

Program::~Program() {
  if (id_ == 0) return;
  try {
    const Current current(*device_);
    glDeleteProgram(id_);
  } catch (const DeviceError&) {
    // With the context went everything in it.
  }
}

void Program::set(const char* uniform, int value) {
  const Current current(*device_);
  const GLint location = glGetUniformLocation(id_, uniform);
  if (location >= 0) glProgramUniform1i(id_, location, value);
}

void Program::set(const char* uniform, float value) {
  const Current current(*device_);
  const GLint location = glGetUniformLocation(id_, uniform);
  if (location >= 0) glProgramUniform1f(id_, location, value);
}

void Program::run(std::int64_t groups, const std::vector<const Buffer*>& buffers, const TextureArray* texture,
                  const Buffer* constants) {
  if (groups <= 0) return;
  const Current current(*device_);
  for (std::size_t i = 0; i < buffers.size(); ++i)
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, static_cast<GLuint>(i), buffers[i]->id_);
  if (constants) glBindBufferBase(GL_UNIFORM_BUFFER, 0, constants->id_);
  if (texture) glBindTextureUnit(0, texture->id_);
  glUseProgram(id_);
  const std::int64_t rows = (groups + kGroupsAlongX - 1) / kGroupsAlongX;
  glDispatchCompute(static_cast<GLuint>((groups + rows - 1) / rows), static_cast<GLuint>(rows), 1);
  glMemoryBarrier(GL_ALL_BARRIER_BITS);
  device_->check("running " + name_);
}

}  // namespace skysweep::gpu
