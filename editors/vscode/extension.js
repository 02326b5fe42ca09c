// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: The Gable authors
//
// Gable in Visual Studio Code: the language server, and a button that shows the place in the browser.
"use strict";

const { spawn } = require("node:child_process");
const path = require("node:path");
const vscode = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");

const LANGUAGES = ["cga", "gable-gbbg", "gable-park", "gable-progen3d"];
const MODELS = { glTF: ["glb", "gltf"], OBJ: ["obj"], Picture: ["png"] };

let client;
/** The studios that run, by the folder that they serve: { process, url }. */
const studios = new Map();

const program = () =>
  vscode.workspace.getConfiguration("gable").get("path") || "gable";

async function startClient() {
  const server = { command: program(), args: ["lsp"] };
  client = new LanguageClient(
    "gable",
    "Gable",
    { run: server, debug: server },
    {
      documentSelector: LANGUAGES.map((language) => ({ language })),
      synchronize: {
        fileEvents: vscode.workspace.createFileSystemWatcher(
          "**/*.{cga,gbbg,park,grammar,pg3d}",
        ),
      },
    },
  );
  try {
    await client.start();
  } catch (error) {
    client = undefined;
    missing(error);
  }
}

async function stopClient() {
  const old = client;
  client = undefined;
  if (old) await old.stop();
}

function missing(error) {
  const settings = "Open Settings";
  vscode.window
    .showErrorMessage(
      `'${program()}' could not be started (${error.message}). Install Gable, or set gable.path.`,
      settings,
    )
    .then((choice) => {
      if (choice === settings)
        vscode.commands.executeCommand(
          "workbench.action.openSettings",
          "gable.path",
        );
    });
}

/** The rule file of the editor in front, saved; undefined where there is none. */
async function ruleFile() {
  const document = vscode.window.activeTextEditor?.document;
  if (!document || !LANGUAGES.includes(document.languageId)) return undefined;
  if (document.isUntitled || document.isDirty) await document.save();
  return document.uri.scheme === "file" ? document.uri.fsPath : undefined;
}

/** The folder that the studio is to serve: the workspace's, else the file's own. */
function folderOf(file) {
  const workspace = vscode.workspace.getWorkspaceFolder(vscode.Uri.file(file));
  return workspace ? workspace.uri.fsPath : path.dirname(file);
}

/** The address of a running studio for a folder; starts one where there is none. */
function studioFor(folder) {
  const known = studios.get(folder);
  if (known) return known.url;
  const child = spawn(program(), ["studio", folder], {
    stdio: ["ignore", "pipe", "pipe"],
  });
  const url = new Promise((done, failed) => {
    let out = "";
    let wrong = "";
    child.stdout.on("data", (bytes) => {
      out += bytes;
      const end = out.indexOf("\n");
      if (end >= 0) done(out.slice(0, end).trim());
    });
    child.stderr.on("data", (bytes) => (wrong += bytes));
    child.on("error", failed);
    child.on("exit", () => {
      studios.delete(folder);
      failed(new Error(wrong.trim() || "it ended"));
    });
  });
  studios.set(folder, { process: child, url });
  return url;
}

async function preview() {
  const file = await ruleFile();
  if (!file) return;
  try {
    const folder = folderOf(file);
    const inside = path
      .relative(folder, file)
      .split(path.sep)
      .map(encodeURIComponent)
      .join("/");
    const url = await studioFor(folder);
    await vscode.env.openExternal(vscode.Uri.parse(`${url}#file=${inside}`));
  } catch (error) {
    missing(error);
  }
}

async function generate() {
  const file = await ruleFile();
  if (!file) return;
  const target = await vscode.window.showSaveDialog({
    defaultUri: vscode.Uri.file(file.replace(/\.\w+$/, ".glb")),
    filters: MODELS,
  });
  if (!target) return;
  const task = new vscode.Task(
    { type: "gable" },
    vscode.TaskScope.Workspace,
    `generate ${path.basename(file)}`,
    "gable",
    new vscode.ProcessExecution(program(), [
      "generate",
      file,
      "-o",
      target.fsPath,
    ]),
  );
  await vscode.tasks.executeTask(task);
}

async function activate(context) {
  context.subscriptions.push(
    vscode.commands.registerCommand("gable.preview", preview),
    vscode.commands.registerCommand("gable.generate", generate),
    vscode.commands.registerCommand("gable.restart", async () => {
      await stopClient();
      await startClient();
    }),
  );
  await startClient();
}

async function deactivate() {
  for (const studio of studios.values()) studio.process.kill();
  studios.clear();
  await stopClient();
}

module.exports = { activate, deactivate };
