// GLSL as the compiler reads it: glslang set up for a compute kernel of Vulkan 1.1.
#pragma once
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>

#include <memory>
#include <mutex>
#include <string>

namespace test {

constexpr auto kGlslMessages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);

/// The front end alone: finds what is missing or there twice, in a fiftieth of the time of a whole compilation. `parsed` and the shader's log tell.
struct ParsedGlsl {
    std::unique_ptr<glslang::TShader> shader;
    bool parsed = false;
};

inline ParsedGlsl parseGlsl(const std::string& source) {
    static std::once_flag once;  // glslang keeps global state from here to the end of the process
    std::call_once(once, [] { glslang::InitializeProcess(); });
    ParsedGlsl result{std::make_unique<glslang::TShader>(EShLangCompute)};
    const char* text = source.c_str();
    result.shader->setStrings(&text, 1);
    result.shader->setEnvInput(glslang::EShSourceGlsl, EShLangCompute, glslang::EShClientVulkan, 100);
    result.shader->setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_1);
    result.shader->setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_3);
    result.parsed = result.shader->parse(GetDefaultResources(), 460, false, kGlslMessages);
    return result;
}

}  // namespace test
